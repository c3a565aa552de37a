#!/usr/bin/env python3
"""Measures wall time and peak memory of ceres_dhcal on whole problems.

  tools/measure.py [--program build/release/bin/ceres_dhcal] [--repeat 5] [--diagnosis never] [PROBLEM.yaml ...]

Without problems: problems/cases/kr15.yaml, and the UR10 series when DHCAL_DATA is set. Prints the best and
the median of the runs, and the bar of each case where there is one.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BARS = {"kr15": (0.2, None), "ur10_ipa_a": (3.0, 300.0)}  # seconds, MB


def run_once(program, problem, out, diagnosis):
    """Runs the program; returns (seconds, peak MB, exit status)."""
    begin = time.perf_counter()
    child = subprocess.Popen([program, "--quiet", "--diagnosis", diagnosis, "--problem", problem, "--out", out])
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    return seconds, usage.ru_maxrss / 1024.0, child.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/ceres_dhcal"))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--diagnosis", default="never", help="never (default), auto or always")
    parser.add_argument("problems", nargs="*")
    options = parser.parse_args()
    if not os.access(options.program, os.X_OK):
        sys.exit(f"measure.py: {options.program} is not there; run tools/run.sh first")
    problems = options.problems or [str(ROOT / "problems/cases/kr15.yaml")]
    if not options.problems and os.environ.get("DHCAL_DATA"):
        problems += [str(ROOT / f"problems/cases/ur10_ipa_{s}.yaml") for s in "ab"]

    print(f"{'problem':<16}{'best [s]':>10}{'median [s]':>12}{'peak [MB]':>11}{'exit':>6}  bar")
    for problem in problems:
        name = pathlib.Path(problem).stem
        with tempfile.TemporaryDirectory() as folder:
            runs = [run_once(options.program, problem, folder + "/out", options.diagnosis)
                    for _ in range(options.repeat)]
        seconds = [run[0] for run in runs]
        bar_seconds, bar_memory = BARS.get(name, (None, None))
        bar = "" if bar_seconds is None else f"{bar_seconds} s"
        bar += "" if bar_memory is None else f", {bar_memory:.0f} MB"
        print(f"{name:<16}{min(seconds):>10.3f}{statistics.median(seconds):>12.3f}"
              f"{max(run[1] for run in runs):>11.1f}{runs[-1][2]:>6}  {bar}")


if __name__ == "__main__":
    main()
