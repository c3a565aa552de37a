"""The loop of English et al. (2004) as one command: plan, measure, calibrate, diagnose, correct a
trajectory, measure again.

Robot, head and edge are simulated in this folder, which shares no code with the programs that plan,
identify and correct. One draw of noise scatters: the bars are for all seeds together. Exit status:
0 both bars are met, 1 one is missed, 2 bad command line or a step without a result.
"""

import argparse
import pathlib
import sys
import time

sys.dont_write_bytecode = True  # leave no __pycache__ in tools/

import report  # noqa: E402  (that had to be said first)
import steps  # noqa: E402
from programs import Failed, Programs, write_table  # noqa: E402
from robot import LEFT_OUT  # noqa: E402


def seeds_of(text):
    """[1, 2, 5, 6, 7] of 1,2,5-7"""
    seeds = []
    try:
        for part in text.split(","):
            first, _, last = part.partition("-")
            seeds += range(int(first), int(last or first) + 1)
    except ValueError:
        seeds = []
    if not seeds:
        raise argparse.ArgumentTypeError(f"'{text}', but whole numbers are expected: 1,4,7-9")
    return seeds


def options_of(words):
    parser = argparse.ArgumentParser(prog="python3 tools/paper_loop", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("paper_loop"),
                        help="folder for all files (default: %(default)s)")
    parser.add_argument("--seeds", type=seeds_of, default="1-20",
                        help="of noise, of where edge and head are mounted (default: %(default)s)")
    parser.add_argument("--robot", choices=sorted(LEFT_OUT), default="A",
                        help="whose physics is left out, in robot.py (default: %(default)s)")
    parser.add_argument("--placements", type=int, default=12,
                        help="of the edge (default: %(default)s)")
    parser.add_argument("--candidates", type=int, default=600,
                        help="placements that the plan chooses from (default: %(default)s)")
    parser.add_argument("--images", action="store_true",
                        help="the first seed again, its ruler read from photographs (dhcal_ruler)")
    parser.add_argument("--programs", type=pathlib.Path,
                        help="folder of the programs (default: build/release/bin, else the PATH)")
    return parser.parse_args(words)


def go(options):
    programs = Programs(options.programs and options.programs.absolute())
    if options.images:
        programs.find("dhcal_ruler")
    options.out.mkdir(parents=True, exist_ok=True)
    plan = steps.make_plan(options, programs)
    print(f"Planned: {len(plan.edges.planned)} placements of an edge, {len(plan.poses)} poses "
          f"({options.out}/plan.txt).\nTrajectory: {len(plan.points)} points, lines and a spiral.")
    print(report.HEADS, flush=True)
    outcomes = []
    for seed in options.seeds:
        outcomes.append(steps.go_round(options.out, plan, programs, seed))
        print(report.row_of(outcomes[-1]), flush=True)
    print(report.row_of_all(outcomes), flush=True)
    if options.images:
        seed = options.seeds[0]
        print(report.row_of(steps.go_round(options.out, plan, programs, seed, images=True), " img"))
    write_table(options.out / "figures.csv",
                ["seed", "before_rms_m", "rigid_rms_m", "after_rms_m", "predicted_rms_m",
                 "verdict"],
                [[o.seed, o.before[1], o.rigid[1], o.after[1], o.predicted, o.verdict]
                 for o in outcomes])
    met, words = report.judge(outcomes)
    print(f"\n{words}")
    return 0 if met else 1


def main(words):
    options, began = options_of(words), time.monotonic()
    try:
        status = go(options)
    except (Failed, OSError) as error:
        print(f"paper_loop: {error}", file=sys.stderr)
        return 2
    print(f"({time.monotonic() - began:.0f} s)")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
