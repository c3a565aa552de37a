"""Calibration of serial robots from Python: what ceres_dhcal computes, to the last bit.

    import dhcal

    problem = dhcal.Problem("problem.yaml")            # or a dict with the same keys
    problem = dhcal.Problem(keys, recording=frame)     # a pandas frame, or {"q1_deg": [...], ...}
    result = problem.identify()                        # the dict that result.json holds
    result.calibrated().fk(q)                          # pose of the tool as the robot really stands

Keys of a problem, columns of a recording and keys of a result: problems/FORMATS.md. Joint
coordinates are in rad (of slides in m), poses 4 x 4 [m] of the measured point in the measurement
frame. What is wrong with the input is told by InputError, in the words of the program.
"""

import csv
import json
import math
import os
import pathlib
import shutil
import tempfile
import weakref

import numpy as np

from ._dhcal import InputError, version as __version__
from . import _dhcal

__all__ = ["InputError", "Problem", "Result", "__version__"]


def _scratch_folder(owner):
    """A folder that lives as long as `owner`."""
    folder = tempfile.mkdtemp(prefix="dhcal_")
    weakref.finalize(owner, shutil.rmtree, folder, ignore_errors=True)
    return folder


def _plain(value):
    """numpy's numbers and arrays as JSON has them."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, pathlib.PurePath):
        return str(value)
    raise TypeError(f"a problem cannot hold {value!r}")


def _cell(value):
    """A number so that it reads back exactly; blank where it is not there."""
    if value is None or (isinstance(value, (float, np.floating)) and math.isnan(value)):
        return ""
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def _write_table(table, file):
    """A pandas frame, a numpy record array or a mapping of columns as the CSV that is read."""
    names = list(table.dtype.names if isinstance(table, np.ndarray) else table.keys())
    columns = [list(table[name]) for name in names]
    if len({len(column) for column in columns}) > 1:
        raise InputError("the columns of the recording are not equally long")
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(names)
        writer.writerows([_cell(value) for value in row] for row in zip(*columns))


class Problem:
    """A problem: of a file, or of a dict with the keys of a problem file."""

    def __init__(self, problem, recording=None, *, data_dir=None):
        """`recording`: a file, or a table of columns; by default what the problem names. Relative
        paths in a dict are relative to the current folder."""
        self._folder = _scratch_folder(self)
        recording = self._file_of(recording)
        if isinstance(problem, dict):
            problem = self._store(problem, recording)
        if data_dir is None:
            data_dir = os.environ.get("DHCAL_DATA", "")
        self._problem = _dhcal.Problem(os.fspath(problem), recording, os.fspath(data_dir))

    def _file_of(self, recording):
        if recording is None:
            return ""
        if isinstance(recording, (str, os.PathLike)):
            return os.path.abspath(recording)
        file = os.path.join(self._folder, "recording.csv")
        _write_table(recording, file)
        return file

    def _store(self, keys, recording):
        """The dict as a problem file: JSON is YAML."""
        keys = {"schema": 1, **keys}
        if recording:
            keys.pop("simulate", None)
            keys["recording"] = recording
        elif "recording" in keys and not str(keys["recording"]).startswith("${"):
            keys["recording"] = os.path.abspath(os.path.expanduser(keys["recording"]))
        file = os.path.join(self._folder, "problem.yaml")
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(keys, stream, default=_plain, allow_nan=False, indent=1)
        return file

    @property
    def num_joints(self):
        """Of the robot; so many coordinates has a row of `fk`."""
        return self._problem.num_joints

    def identify(self, *, diagnosis=""):
        """Calibrates and looks for left-out physics, as `ceres_dhcal` does. `diagnosis`: auto,
        always or never instead of what the problem says."""
        return Result(self, self._problem.identify(diagnosis))

    def fk(self, q):
        """Pose (4, 4) of the measured point for joint coordinates (n,), or (m, 4, 4) for (m, n):
        geometry and held effects of the problem."""
        q = np.asarray(q, dtype=float)
        poses = np.array(self._problem.forward(np.atleast_2d(q))).reshape(-1, 4, 4)
        return poses[0] if q.ndim == 1 else poses

    def ik(self, pose, seed):
        """Joint coordinates at which `fk` gives the pose (4, 4), or those of (m, 4, 4) in a row,
        the first near `seed`. InputError where there are none."""
        pose = np.asarray(pose, dtype=float)
        poses = list(pose.reshape(-1, 4, 4))
        q = self._problem.inverse(poses, np.asarray(seed, dtype=float))
        return q[0] if pose.ndim == 2 else q


class Result(dict):
    """What result.json holds."""

    def __init__(self, problem, calibration):
        super().__init__(json.loads(calibration.json()))
        self._problem = problem  # keeps the files that the calibration refers to
        self._calibration = calibration

    @property
    def usable(self):
        """Whether there is a calibration; where not, `setup` and `fits` say why."""
        return self._calibration.usable

    def save(self, folder):
        """Writes the result folder of `ceres_dhcal`."""
        self._calibration.save(os.path.abspath(folder))

    def calibrated(self):
        """The problem of calibrated.yaml: the robot as it really is."""
        if not self.usable:
            raise InputError("there is no usable result; its keys setup and fits say why")
        folder = _scratch_folder(self)
        self.save(os.path.join(folder, "result"))
        problem = Problem(os.path.join(folder, "result", "calibrated.yaml"))
        problem._result = self  # its folder holds the files that the problem refers to
        return problem
