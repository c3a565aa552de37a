"""A KUKA KR 15/2 as drawn, and the one that stands in the workshop.

The second has the 24 errors of English et al. (2004), Table III, and physics that no file of the
user mentions. Nothing here is shared with the programs that have to find them: rows are multiplied
as matrices, loads follow the arm until it rests, play is a gap with a memory.
"""

import dataclasses
import math

from frames import Pose, cross, dot, norm, plus, turned

GRAVITY = (0, 0, -9.80665)  # [m/s^2]
# theta [rad], d [m], a [m], alpha [rad] of each row; mass [kg], its centre [m] in the row's frame
DRAWN = [((0, 0.675, 0.300, math.pi / 2), 60, (-0.2, 0.1, 0)),
         ((0, 0, 0.650, 0), 40, (-0.35, 0, 0.05)),
         ((0, 0, 0.155, math.pi / 2), 35, (-0.02, 0, 0.1)),
         ((0, 0.600, 0, -math.pi / 2), 15, (0, 0.15, 0)),
         ((0, 0, 0, math.pi / 2), 8, (0, 0, 0.03)),
         ((0, 0.140, 0, 0), 3, (0, 0, -0.03))]
HEAD = 5, (0, 0, 0.1)  # [kg], centre [m] in the frame of the flange
TOOL = (0, 0, 0.2)  # [m] from the flange to the measured point
HOME = tuple(math.radians(x) for x in (0, 60, 30, 0, 60, 0))  # where every motion begins
# Table III, in the order of a row: 1e-6 rad and 1e-6 m
ERRORS = [(870, -75, 31, 157), (940, 31, 51, 130), (-1000, 22, 12, -160),
          (620, 48, -45, -253), (-810, -20, 64, 462), (260, 78, 58, -320)]


@dataclasses.dataclass(frozen=True)
class Physics:
    """What the drawing does not mention; joints count from 0."""

    compliance: tuple = ()  # (joint, [rad/(N m)])
    lines: tuple = ()  # (joint, cycles per turn, amplitude [rad], phase [rad]) of gears
    play: tuple = ()  # (joint, gap [rad])


LEFT_OUT = {
    "A": Physics(compliance=((1, 3e-6),), lines=((2, 1, 0.25e-3, 0.4), (2, 2, 0.15e-3, 1.9)),
                 play=((3, 0.4e-3),)),
    "B": Physics(compliance=((1, 3e-6), (2, 5e-6)), lines=((0, 2, 0.15e-3, 0.4),),
                 play=((4, 0.4e-3),)),
    "C": Physics(compliance=((1, 4e-6),), lines=((3, 2, 0.2e-3, 1.0),), play=((5, 0.5e-3),)),
    "D": Physics(compliance=((2, 6e-6),), lines=((1, 1, 0.3e-3, 1.0),)),
    "E": Physics()}


def names_of(physics):
    """In the library's words, joints from 1, with orders: what a right answer holds."""
    return ({("joint_compliance", joint + 1, None) for joint, _ in physics.compliance}
            | {("gear_harmonic", joint + 1, cycles) for joint, cycles, _, _ in physics.lines}
            | {("backlash", joint + 1, None) for joint, _ in physics.play})


class Robot:
    """An arm that remembers on which side of their gaps its joints lie."""

    def __init__(self, rows, physics=Physics(), X_TQ=Pose(shift=TOOL)):
        self.rows, self.physics, self.X_TQ = rows, physics, X_TQ
        self.links = {}  # joint: [rad] where the link is

    def frames(self, angles):
        """Of the base and of all rows, for the angles that the links really have."""
        frames = [Pose()]
        for (theta, d, a, alpha), angle in zip(self.rows, angles):
            c, s = math.cos(theta + angle), math.sin(theta + angle)
            ca, sa = math.cos(alpha), math.sin(alpha)
            turn = ((c, -s * ca, s * sa), (s, c * ca, -c * sa), (0, sa, ca))
            frames.append(frames[-1] * Pose(turn, (a * c, a * s, d)))
        return frames

    def torque(self, frames, joint):
        """[N m] of gravity about a joint's axis, of all that lies beyond it."""
        origin, axis = frames[joint].shift, frames[joint].axis(2)
        bodies = [(mass, frame.point(centre)) for (_, mass, centre), frame
                  in list(zip(DRAWN, frames[1:]))[joint:]] + [(HEAD[0], frames[-1].point(HEAD[1]))]
        return sum(mass * dot(axis, cross(plus(at, origin, -1), GRAVITY)) for mass, at in bodies)

    def across_gaps(self, q):
        """[rad] A link follows its motor once the gap is closed."""
        angles = list(q)
        for joint, gap in self.physics.play:
            before = self.links.get(joint, q[joint])
            angles[joint] = min(max(before, q[joint] - gap / 2), q[joint] + gap / 2)
            self.links[joint] = angles[joint]
        return angles

    def go(self, q):
        """X_BQ where the tool comes to rest when the controller says q [rad]."""
        held = self.across_gaps(q)
        for joint, cycles, amplitude, phase in self.physics.lines:
            held[joint] += amplitude * math.sin(cycles * q[joint] + phase)
        frames, moved = self.frames(held), math.inf
        while moved > 1e-12:
            angles = list(held)
            for joint, compliance in self.physics.compliance:
                angles[joint] += compliance * self.torque(frames, joint)
            before, frames = frames, self.frames(angles)
            moved = norm(plus(frames[-1].shift, before[-1].shift, -1))
        return frames[-1] * self.X_TQ

    def follow(self, commands):
        """[m] The tool's points along commands, from HOME."""
        self.links = {}
        self.go(HOME)
        return [self.go(q).shift for q in commands]


def drawn():
    return Robot([row for row, _, _ in DRAWN])


def built(rng, physics):
    """The real robot; the head sits on its flange a little elsewhere each time."""
    rows = [tuple(x + 1e-6 * error for x, error in zip(row, errors))
            for (row, _, _), errors in zip(DRAWN, ERRORS)]
    shift = tuple(x + rng.gauss(0, 0.3e-3) for x in TOOL)
    return Robot(rows, physics, turned([rng.gauss(0, 1e-3) for _ in range(3)], shift))


def senses(commands):
    """Of the last motion of each joint before every command, from HOME: -1, 0, 1."""
    before, sense, all_senses = HOME, (0,) * len(HOME), []
    for q in commands:
        sense = tuple((a > b) - (a < b) or last for a, b, last in zip(q, before, sense))
        all_senses.append(sense)
        before = q
    return all_senses
