"""Tests the loop of the paper, tools/paper_loop: python3 paper_loop_test.py PROGRAMS [TEST...]

PROGRAMS is the folder of the built programs. What the loop simulates is held to laws and to lengths
by hand; then the whole of it runs once, on a small plan.
"""

import contextlib
import csv
import importlib.util
import io
import math
import pathlib
import random
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tools/ or tests/
ROOT = pathlib.Path(__file__).resolve().parents[2]
LOOP = ROOT / "tools/paper_loop"
sys.path.insert(0, str(LOOP))

import head  # noqa: E402  (their folder had to be made known first)
import photographs  # noqa: E402
import report  # noqa: E402
import robot  # noqa: E402
import trajectory  # noqa: E402
from frames import Pose, dot, norm, plus, turned  # noqa: E402
from programs import Failed, Programs  # noqa: E402
from steps import Outcome  # noqa: E402

PROGRAMS = "build/release/bin"
STRETCHED = (0, math.pi / 2, 0, 0, 0, 0)  # the upper arm upright, the forearm level


def loop(*words):
    """(exit status, what it printed to stdout, to stderr)"""
    spec = importlib.util.spec_from_file_location("paper_loop_main", LOOP / "__main__.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = module.main([str(word) for word in words])
        except SystemExit as end:
            status = end.code
    return status, out.getvalue(), err.getvalue()


def over_the_edge(along, tilt, height=0.06):
    """X_EQ: the tool looks down on the edge, turned by a rotation vector of its own."""
    return Pose(((1, 0, 0), (0, -1, 0), (0, 0, -1)), (along, 0, height)) * turned(tilt)


class RobotTest(unittest.TestCase):
    def test_stands_where_its_lengths_add_up(self):
        X_BQ = robot.drawn().go(STRETCHED)
        for number, by_hand in zip(X_BQ.shift, (0.3 + 0.6 + 0.14 + 0.2, 0, 0.675 + 0.65 + 0.155)):
            self.assertAlmostEqual(number, by_hand, places=12)
        self.assertAlmostEqual(X_BQ.axis(2)[0], 1, places=12)

    def test_torque_is_the_slope_of_the_potential(self):
        arm = robot.drawn()
        q, step = (0.3, 1.1, -0.4, 0.7, 0.9, -0.5), 1e-6

        def height_times_mass(angles):
            frames = arm.frames(angles)
            links = sum(mass * frame.point(centre)[2]
                        for (_, mass, centre), frame in zip(robot.DRAWN, frames[1:]))
            return links + robot.HEAD[0] * frames[-1].point(robot.HEAD[1])[2]
        for joint in range(6):
            more, less = (height_times_mass([x + s * step * (k == joint) for k, x in enumerate(q)])
                          for s in (1, -1))
            torque = -9.80665 * (more - less) / (2 * step)
            self.assertAlmostEqual(arm.torque(arm.frames(q), joint), torque, places=5)

    def test_a_compliant_joint_sags_by_its_load_on_its_lever(self):
        compliance = 3e-6
        arm = robot.Robot(robot.drawn().rows, robot.Physics(compliance=((1, compliance),)))
        torque = arm.torque(arm.frames(STRETCHED), 1)
        sag = arm.go(STRETCHED).shift[2] - robot.drawn().go(STRETCHED).shift[2]
        by_hand = -compliance * abs(torque) * (1.24 - 0.3)
        self.assertAlmostEqual(sag, by_hand, delta=0.005 * abs(by_hand))  # the load follows the arm

    def test_play_keeps_a_link_until_the_gap_is_crossed(self):
        arm = robot.Robot(robot.drawn().rows, robot.Physics(play=((3, 0.004),)))

        def link_at(angle):
            return arm.across_gaps((0, 0, 0, angle, 0, 0))[3]
        link_at(0)
        self.assertAlmostEqual(link_at(0.1), 0.098)
        self.assertAlmostEqual(link_at(0.099), 0.098, msg="within the gap")
        self.assertAlmostEqual(link_at(0.05), 0.052)

    def test_senses_are_those_of_the_last_motion(self):
        up = tuple(x + 0.1 for x in robot.HOME)
        self.assertEqual(robot.senses([up, up, robot.HOME]), [(1,) * 6, (1,) * 6, (-1,) * 6])


class HeadTest(unittest.TestCase):
    def test_reads_along_its_sights(self):
        ruler, height1, height2 = head.numbers(over_the_edge(0.1, (0, 0, 0)))
        self.assertAlmostEqual(ruler, head.RULER_BEGINS + 0.1 + 0.02)
        self.assertAlmostEqual(height1, 0.05)
        # Tilted by t about its y axis the camera, 20 mm along x, looks on by the tangent.
        t = math.radians(25)
        ruler, height1, height2 = head.numbers(over_the_edge(0.1, (0, t, 0)))
        lifted = 0.06 + 0.02 * math.sin(t)
        self.assertAlmostEqual(ruler - head.RULER_BEGINS,
                               0.1 + 0.02 * math.cos(t) + lifted * math.tan(t))
        self.assertAlmostEqual(height1, height2)

    def test_finds_the_edges_of_a_plan(self):
        line = "P167: {xyz_mm: [394, -69, 253], rpy_deg: [0, 0, 90]}"
        edges = head.Edges(f"measurement.edges\n\n  {line}\n")
        self.assertEqual(edges.lines, [line])
        self.assertAlmostEqual(edges.planned["P167"].point((1, 0, 0))[1], -0.069 + 1)

    def test_photographs_show_what_the_camera_reads(self):
        try:
            Programs(PROGRAMS).find("dhcal_ruler")
        except Failed:
            self.skipTest("dhcal_ruler is not built")
        rng = random.Random(1)
        poses = [over_the_edge(-0.1 + 0.026 * k, [rng.uniform(-0.4, 0.4) for _ in range(3)])
                 for k in range(6)]
        truth = [1e3 * head.numbers(X_EQ)[0] for X_EQ in poses]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            images = [f"{k}.png" for k in range(len(poses))]
            for image, X_EQ in zip(images, poses):
                seen = photographs.photograph(X_EQ, photographs.camera_turn(poses), 0, rng)
                (folder / image).write_bytes(photographs.png(seen))
            (folder / "coarse.csv").write_text("coarse_mm\n" + "".join(f"{x:.0f}\n" for x in truth))
            printed = Programs(PROGRAMS).run(folder, "dhcal_ruler", *images, "--pitch_mm",
                                             1e3 * photographs.PITCH, "--coarse", "coarse.csv")
        read = [float(line["ruler_mm"]) for line in csv.DictReader(printed.splitlines())]
        for one, true in zip(read, truth):
            self.assertAlmostEqual(one - read[0], true - truth[0], delta=0.003)  # [mm]


class TrajectoryTest(unittest.TestCase):
    def test_a_motion_of_the_whole_is_no_error(self):
        points = trajectory.wanted_points()
        motion = turned((0.01, -0.02, 0.015), (0.01, 0.02, -0.005))
        errors = [plus(motion.point(p), p, -1) for p in points]
        self.assertGreater(trajectory.figures(errors)[1], 5e-3)
        self.assertLess(trajectory.figures(trajectory.without_motion(points, errors))[2], 1e-9)

    def test_what_no_motion_makes_stays(self):
        points = trajectory.wanted_points()
        # A stretch about the middle.
        middle = trajectory.mean(points)
        errors = [tuple(1e-4 * x for x in plus(p, middle, -1)) for p in points]
        left = trajectory.without_motion(points, errors)
        self.assertLess(max(norm(plus(a, b, -1)) for a, b in zip(left, errors)), 1e-12)

    def test_steps_are_small_and_the_spiral_keeps_its_radius(self):
        points = trajectory.wanted_points()
        self.assertLess(max(math.dist(a, b) for a, b in zip(points, points[1:])), 0.06)
        out = plus(points[-1], trajectory.CORNERS[-1], -1)
        self.assertAlmostEqual(dot(out[:2] + (0,), out[:2] + (0,)), trajectory.RADIUS**2)


class BarsTest(unittest.TestCase):
    def outcome(self, before, after, predicted):
        return Outcome(1, (before,) * 3, (before,) * 3, (after,) * 3, predicted, "explained", True)

    def test_are_held_by_all_seeds_together(self):
        self.assertTrue(report.judge([self.outcome(200, 9, 9)])[0])
        self.assertFalse(report.judge([self.outcome(100, 9, 9)])[0])
        met, words = report.judge([self.outcome(200, 9, 8)])
        self.assertFalse(met)
        self.assertIn("1.12 times what was predicted (at most 1.1): MISSED", words)
        self.assertTrue(report.judge([self.outcome(200, 9, 8), self.outcome(200, 7, 8)])[0])


class LoopTest(unittest.TestCase):
    def test_makes_the_trajectory_as_good_as_it_says(self):
        with tempfile.TemporaryDirectory() as folder:
            status, out, err = loop("--out", folder, "--seeds", 1, "--candidates", 100,
                                    "--programs", PROGRAMS)
            self.assertEqual((status, err), (0, ""), out)
            with open(pathlib.Path(folder, "figures.csv"), newline="", encoding="utf-8") as file:
                (figures,) = csv.DictReader(file)
            before, rigid, after, predicted = (float(figures[f"{name}_rms_m"]) for name in (
                "before", "rigid", "after", "predicted"))
            self.assertGreater(before / after, report.BETTER)
            self.assertGreater(rigid / after, 5, "the physics that was left out is most of it")
            self.assertLess(after / predicted, report.REALISED)
            self.assertEqual(figures["verdict"], "explained")
            self.assertIn("1 of 1 right", out)
            self.assertIn(": met\n", out)

    def test_says_what_it_lacks(self):
        with tempfile.TemporaryDirectory() as folder:
            status, out, err = loop("--out", folder, "--programs", folder)
            self.assertEqual((status, out), (2, ""))
            self.assertIn(f"dhcal_plan is not in {folder}", err)
            status, _, err = loop("--out", folder, "--programs", PROGRAMS, "--candidates", 0)
            self.assertEqual(status, 2)
            self.assertIn("--candidates is '0'", err)
            self.assertEqual(loop("--seeds", "5-3")[0], 2)


if __name__ == "__main__":
    PROGRAMS = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
