"""The work: straight lines and a spiral through the region of the task, with the tool held as it
is; and how far a tool is off them."""

import math

from frames import cross, dot, norm, plus, solve3, turned

STEP = 0.02  # [m]
RPY_DEG = (165, 25, 0)  # of the tool: it points down and aslant, away from a stretched wrist
CORNERS = ((0.85, -0.35, 0.35), (0.85, 0.35, 0.35), (1.15, 0.35, 0.45), (1.15, -0.35, 0.45),
           (0.85, -0.35, 0.80), (0.85, 0.35, 0.80), (1.15, 0.35, 0.90), (1.15, -0.35, 0.90),
           (0.85, 0.35, 0.35), (1.0, 0, 0.5))  # [m]
RADIUS, TURNS, RISE = 0.2, 4, 0.3  # of the spiral from the last corner [m]


def line(a, b):
    """Points from a to b, a included."""
    way = plus(b, a, -1)
    steps = max(1, round(norm(way) / STEP))
    return [plus(a, way, k / steps) for k in range(steps)]


def spiral(middle):
    """Outwards and up, in even steps."""
    steps = round(math.pi * TURNS * RADIUS / STEP)
    for k in range(steps + 1):
        share = math.sqrt(k / steps)
        angle = 2 * math.pi * TURNS * share
        yield plus(middle, (RADIUS * share * math.cos(angle), RADIUS * share * math.sin(angle),
                            RISE * share))


def wanted_points():
    """[m] in the base of the robot."""
    lines = [point for a, b in zip(CORNERS, CORNERS[1:]) for point in line(a, b)]
    return lines + list(spiral(CORNERS[-1]))


def mean(vectors):
    return tuple(sum(x) / len(vectors) for x in zip(*vectors))


def without_motion(points, errors):
    """The errors once the points as a whole were moved to fit best: along edges that nobody has
    measured no reading says where the robot stands."""
    middle = mean(points)
    arms = [plus(point, middle, -1) for point in points]
    inertia = [[sum((dot(a, a) if i == j else 0) - a[i] * a[j] for a in arms) for j in range(3)]
               for i in range(3)]
    left = list(errors)
    for _ in range(3):  # linear in the turn, so once more and again
        shift = mean(left)
        moment = mean([cross(a, e) for a, e in zip(arms, left)])
        turn = solve3(inertia, tuple(len(arms) * m for m in moment))
        back = turned([-x for x in turn])
        left = [plus(back.point(plus(a, plus(e, shift, -1))), a, -1) for a, e in zip(arms, left)]
    return left


def root_mean_square(numbers):
    return math.sqrt(sum(x * x for x in numbers) / len(numbers))


def figures(errors):
    """(mean, RMS, worst) of the 3-D lengths."""
    lengths = [norm(error) for error in errors]
    return sum(lengths) / len(lengths), root_mean_square(lengths), max(lengths)
