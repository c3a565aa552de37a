"""The project's programs, and the tables that go in and out of them."""

import csv
import math
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).absolute().parents[2]
BUILT = ROOT / "build/release/bin"
MOST_LINES = 10  # of a program that failed
JOINTS_DEG = [f"q{joint}_deg" for joint in range(1, 7)]


class Failed(Exception):
    """A step of the loop has no result; what was wrong, and what to do."""


class Programs:
    """Those of a folder; without one those that were built, else those on the PATH."""

    def __init__(self, folder=None):
        built = BUILT if (BUILT / "ceres_dhcal").exists() else None
        self.path = str(folder or built or os.environ["PATH"])

    def find(self, name):
        program = shutil.which(name, path=self.path)
        if not program:
            raise Failed(f"{name} is not in {self.path}; build it (tools/run.sh), or say with "
                         "--programs where it is")
        return program

    def run(self, folder, name, *words):
        """What a program prints, run in the folder; Failed where its exit status is not 0."""
        done = subprocess.run([self.find(name), *map(str, words)], cwd=folder, capture_output=True,
                              text=True, check=False)
        if done.returncode != 0:
            said = (done.stderr or done.stdout).splitlines()
            raise Failed(f"{name} in {folder} ended with exit status {done.returncode}:\n"
                         + "\n".join(said[:MOST_LINES] + ["..."] * (len(said) > MOST_LINES)))
        return done.stdout


def write_whole(path, text):
    """Whole or not at all."""
    aside = path.with_name(path.name + ".part")
    aside.write_text(text, encoding="utf-8")
    os.replace(aside, path)


def write_table(path, header, rows):
    write_whole(path, "".join(",".join(map(str, row)) + "\n" for row in [header, *rows]))


def read_joints(path, unit="deg"):
    """([rad] joint angles of each row, the rows as dictionaries)."""
    to_rad = {"deg": math.pi / 180, "rad": 1}[unit]
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = [f"q{joint}_{unit}" for joint in range(1, 7)]
    return [[to_rad * float(row[name]) for name in names] for row in rows], rows


def degrees(q):
    return [f"{math.degrees(x):.6f}" for x in q]
