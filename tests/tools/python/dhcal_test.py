"""Tests the Python module: python3 dhcal_test.py PROGRAMS MODULE BUILT [TEST...]

Numbers are those of the programs in the folder PROGRAMS, to the last bit. Where BUILT is
OFF there is no module, and nothing is tested.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAMS = pathlib.Path("build/release/bin")

JOINTS = [
    {"name": "A1", "d_mm": 400, "a_mm": 25, "alpha_deg": -90, "sign": -1},
    {"name": "A2", "a_mm": 455},
    {"name": "A3", "theta_deg": -90, "a_mm": 35, "alpha_deg": -90},
    {"name": "A4", "d_mm": 420, "alpha_deg": 90, "sign": -1},
    {"name": "A5", "alpha_deg": -90},
    {"name": "A6", "d_mm": 80, "sign": -1},
]
CELL = {
    "schema": 1,
    "name": "cell",
    "robot": {"joints": JOINTS, "tool": {"xyz_mm": [40.0, 0.0, 100.0]}},
    "measurement": {"kind": "position", "sigma_mm": 0.02},
    "simulate": {
        "motion": {"kind": "random", "poses": 60},
        "errors": {"theta_rad": [1e-3, -2e-3, 1e-3, 0, 1e-3, 0]},
        "noise_mm": 0.02,
    },
    "diagnosis": {"run": "never"},
}


def without_times(value):
    """A result without what differs from run to run."""
    if isinstance(value, dict):
        return {key: without_times(each) for key, each in value.items() if key != "seconds"}
    return [without_times(each) for each in value] if isinstance(value, list) else value


def of_program(problem, folder):
    """The result folder that ceres_dhcal writes for a problem file."""
    out = pathlib.Path(folder, "out")
    subprocess.run([PROGRAMS / "ceres_dhcal", "--problem", problem, "--out", out, "--quiet"],
                   check=True)
    return out


def result_json(folder):
    return json.loads(pathlib.Path(folder, "result.json").read_text(encoding="utf-8"))


class DhcalTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def store(self, keys):
        file = self.folder / "cell.yaml"
        file.write_text(json.dumps(keys), encoding="utf-8")
        return file

    def test_a_file_gives_the_numbers_of_the_command_line(self):
        for name in ["kr15", "kr15_left_out"]:
            case = ROOT / f"problems/cases/{name}.yaml"
            result = dhcal.Problem(case).identify()
            wanted = result_json(of_program(case, self.folder))
            self.assertEqual(without_times(result), without_times(wanted))

    def test_a_dict_and_arrays_give_the_numbers_of_the_files(self):
        out = of_program(self.store(CELL), self.folder)
        with open(out / "recording.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
        columns = {name: np.array([float(row[i]) for row in rows[1:]])
                   for i, name in enumerate(rows[0])}
        keys = {key: value for key, value in CELL.items() if key not in ("schema", "simulate")}
        keys["robot"] = {"joints": JOINTS, "tool": {"xyz_mm": np.array([40, 0, 100])}}
        result = dhcal.Problem(keys, recording=columns).identify()
        wanted = without_times(result_json(out))
        wanted["simulated"] = False  # a table is a recording
        self.assertEqual(without_times(result), wanted)

    def test_the_calibrated_robot_stands_as_dhcal_compensate_predicts(self):
        result = dhcal.Problem(ROOT / "problems/cases/kr15_left_out.yaml").identify()
        result.save(self.folder / "result")
        q_deg = np.array([[10.0, 20, -30, 40, 50, 60], [-5, 70, 10, -20, 30, -40]])
        table = self.folder / "q.csv"
        table.write_text("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n" + "\n".join(
            ",".join(map(str, row)) for row in q_deg) + "\n", encoding="utf-8")
        text = subprocess.run(
            [PROGRAMS / "dhcal_compensate", "--model", self.folder / "result/calibrated.yaml",
             "--poses", table, "--predict", "--frame", "world"],
            check=True, capture_output=True, text=True).stdout
        wanted = [[float(row[name]) for name in ("x_mm", "y_mm", "z_mm")]
                  for row in csv.DictReader(text.splitlines())]
        poses = result.calibrated().fk(np.radians(q_deg))
        self.assertEqual(poses.shape, (2, 4, 4))
        np.testing.assert_allclose(1e3 * poses[:, :3, 3], wanted, rtol=0, atol=1e-9)

    def test_fk_of_a_template_is_what_the_teach_pendant_shows(self):
        robot = dhcal.Problem(ROOT / "problems/robots/ur5e.yaml")
        self.assertEqual(robot.num_joints, 6)
        pose = robot.fk(np.zeros(6))
        flange = pose[:3, 3] - 0.1 * pose[:3, 2]  # the template's tool
        np.testing.assert_allclose(flange, [-0.8172, -0.2329, 0.0628], rtol=0, atol=1e-12)

    def test_ik_undoes_fk(self):
        robot = dhcal.Problem(CELL)
        q = np.array([[0.3, -1.2, 1.4, 0.7, -0.8, 0.2], [0.35, -1.1, 1.3, 0.8, -0.9, 0.3]])
        found = robot.ik(robot.fk(q), seed=q[0] + 0.05)
        np.testing.assert_allclose(found, q, rtol=0, atol=1e-8)
        np.testing.assert_allclose(robot.ik(robot.fk(q[0]), seed=q[0]), q[0], rtol=0, atol=1e-8)
        far = np.eye(4)
        far[0, 3] = 50
        with self.assertRaisesRegex(dhcal.InputError, "pose 0"):
            robot.ik(far, seed=q[0])

    def test_what_is_wrong_is_told_in_the_words_of_the_program(self):
        with self.assertRaisesRegex(dhcal.InputError, "measurement"):
            dhcal.Problem({"robot": {"joints": JOINTS}})
        with self.assertRaisesRegex(dhcal.InputError, "sigma_mm"):
            dhcal.Problem({**CELL, "measurement": {"kind": "position", "sigma_m_m": 0.02}})
        with self.assertRaisesRegex(dhcal.InputError, "x_mm"):
            dhcal.Problem(CELL, recording={f"q{i}_deg": [1.0, 2.0] for i in range(1, 7)}).identify()
        with self.assertRaisesRegex(dhcal.InputError, "equally long"):
            dhcal.Problem(CELL, recording={"q1_deg": [1.0], "q2_deg": []})
        with self.assertRaisesRegex(dhcal.InputError, "6 finite"):
            dhcal.Problem(CELL).fk([0, 0])
        with self.assertRaisesRegex(dhcal.InputError, "auto, always or never"):
            dhcal.Problem(CELL).identify(diagnosis="perhaps")


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1))
    sys.path.insert(0, sys.argv.pop(1))
    if sys.argv.pop(1) == "OFF":
        print("skipped: no Python module; it needs pybind11-dev, python3-dev and python3-numpy")
        sys.exit(0)
    import dhcal
    import numpy as np
    unittest.main()
