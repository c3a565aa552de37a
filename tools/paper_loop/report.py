"""The loop's figures as a table, and whether they meet the bars."""

from steps import Outcome
from trajectory import root_mean_square

BETTER = 20  # times, at least
REALISED = 1.1  # times what was predicted, at most

HEADS = """
Error of the trajectory, 3-D, once it was moved as a whole to fit best [um]
         commands of the drawn  corrected:  corrected: with the   predicted  realised
         robot                  rows alone  physics found                    over
    seed    mean    RMS  worst     RMS         mean    RMS  worst       RMS  predicted  names"""


def micrometres(lengths, digits):
    return "".join(f"{1e6 * x:7.{digits}f}" for x in lengths)


def row(name, outcome, names):
    return (f"{name:>8} {micrometres(outcome.before, 0)} {micrometres([outcome.rigid[1]], 0)}     "
            f"{micrometres(outcome.after, 1)}    {micrometres([outcome.predicted], 1)}"
            f"{outcome.after[1] / outcome.predicted:11.2f}  {names}")


def row_of(outcome, what=""):
    names = "right" if outcome.right else outcome.verdict
    return row(f"{outcome.seed}{what}", outcome, names)


def pooled(outcomes):
    """All seeds as one: the mean of means, roots of mean squares, the worst of all."""
    def of(kind):
        means, squares, worst = zip(*(getattr(outcome, kind) for outcome in outcomes))
        return sum(means) / len(means), root_mean_square(squares), max(worst)
    predicted = root_mean_square([outcome.predicted for outcome in outcomes])
    right = all(outcome.right for outcome in outcomes)
    return Outcome(0, of("before"), of("rigid"), of("after"), predicted, "", right)


def row_of_all(outcomes):
    right = sum(outcome.right for outcome in outcomes)
    return row("all", pooled(outcomes), f"{right} of {len(outcomes)} right")


def judge(outcomes):
    """(whether both bars are met by all seeds together, lines that say so)"""
    together = pooled(outcomes)
    better = together.before[1] / together.after[1]
    realised = together.after[1] / together.predicted
    met = better >= BETTER, realised <= REALISED
    words = [{True: "met", False: "MISSED"}[one] for one in met]
    return all(met), (
        f"RMS {better:.1f} times smaller than before (at least {BETTER}): {words[0]}\n"
        f"RMS {realised:.2f} times what was predicted (at most {REALISED}): {words[1]}")
