#!/usr/bin/env python3
"""Draws how large the errors of a recording's rows are before and after, as one SVG.

usage: python3 tools/picture.py RESULT_FOLDER PICTURE.svg

The folder is one that ceres_dhcal wrote, of positions or poses in which effects were found. Rows
that the program set aside are left out, as in its figures. Needs gnuplot. The picture of README:

  ceres_dhcal --problem problems/cases/ur10_ipa_a.yaml --data_dir DATA --out ur10_a
  python3 tools/picture.py ur10_a problems/guides/ur10_before_after.svg
"""

import csv
import math
import pathlib
import re
import subprocess
import sys

BINS_PER_DECADE = 16
LOWEST_MM, HIGHEST_MM = 0.004, 4.0
# column of residuals.csv, colours on light and on dark ground, words, how they stand at the peak
HILLS = [
    ("predicted_before", "#c8501c", "#f0955c", "before: nominal robot,", "base and tool fitted",
     "left"),
    ("predicted_after", "#5b6675", "#a3afbd", "corrected", "geometry", "right"),
    ("predicted_effects", "#0b6fb8", "#5aaef0", "after: corrected geometry",
     "and the physics found", "center"),
]
INKS = [("#1b2430", "#e4e9ef"), ("#d5dbe3", "#36404d")]  # text; rules
PAPER = ("#ffffff", "#12171e")


def errors_of(path):
    """The 3-D errors [mm] of the rows that were used: one list per hill, and how many were not."""
    errors, unused = [[] for _ in HILLS], 0
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["set_aside"]:
                unused += 1
                continue
            for hill, values in zip(HILLS, errors, strict=True):
                values.append(math.dist([float(row[f"measured_{axis}_mm"]) for axis in "xyz"],
                                        [float(row[f"{hill[0]}_{axis}_mm"]) for axis in "xyz"]))
    return errors, unused


def shares(values):
    """(edge [mm], share of the values in the bin that begins there [%]) of all bins."""
    first = math.floor(BINS_PER_DECADE * math.log10(LOWEST_MM))
    last = math.ceil(BINS_PER_DECADE * math.log10(HIGHEST_MM))
    counts = [0] * (last - first)
    for value in values:
        bin_idx = math.floor(BINS_PER_DECADE * math.log10(max(value, LOWEST_MM))) - first
        counts[min(bin_idx, len(counts) - 1)] += 1
    edges = [10 ** ((first + k) / BINS_PER_DECADE) for k in range(len(counts) + 1)]
    return list(zip(edges, [100 * count / len(values) for count in counts] + [0], strict=True))


def ink(index):
    """A colour that stands for the index-th of the palette until the drawing is finished."""
    return f"rgb '#0102{index:02x}'"


def script_of(errors):
    """What gnuplot draws."""
    lines = ["set terminal svg size 880,340 dynamic font 'sans-serif,15' linewidth 1.5",
             f"set border 1 linecolor {ink(0)}", "set key off", "set logscale x",
             f"set xrange [{LOWEST_MM}:{HIGHEST_MM}]", "set yrange [0:17]",
             "set xtics (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2) nomirror scale 0.5",
             f"set xtics textcolor {ink(0)}", f"set ytics 5 scale 0 textcolor {ink(0)}",
             f"set grid ytics linetype 1 linecolor {ink(1)} linewidth 0.5",
             f"set xlabel 'error of a row: measured to predicted point [mm]' textcolor {ink(0)}",
             f"set ylabel 'rows in a bin [%]' textcolor {ink(0)}",
             "set style fill transparent solid 0.25 noborder"]
    plots = []
    for k, (hill, values) in enumerate(zip(HILLS, errors, strict=True)):
        colour = ink(len(INKS) + k)
        bins = shares(values)
        peak_mm, peak = max(bins, key=lambda bin_: bin_[1])
        rms = math.sqrt(sum(value**2 for value in values) / len(values))
        for lift, text in enumerate([f"RMS {rms:#.2g} mm", hill[4], hill[3]]):
            lines.append(f"set label '{text}' at {peak_mm},{peak + 1.0 + 1.3 * lift} {hill[5]} "
                         f"textcolor {colour}")
        block = "\n".join(f"{edge} {share}" for edge, share in bins)
        lines.append(f"$hill{k} << END\n{block}\nEND")
        plots.append(f"$hill{k} with fillsteps linecolor {colour}")
        plots.append(f"$hill{k} with steps linecolor {colour} linewidth 1.2")
    return "\n".join(lines + ["plot " + ", ".join(plots)]) + "\n"


def finished(svg, errors, unused):
    """The drawing with its palette for light and dark, a ground of its own, and a title."""
    palette = INKS + [(hill[1], hill[2]) for hill in HILLS]
    svg = re.sub(r"rgb\(\s*1,\s*2,\s*(\d+)\)", r"var(--ink-\1)", svg)
    svg = re.sub(r"\n*<(title|desc)>[^<]*</\1>", "", svg)
    sides = [";".join([f"--paper:{PAPER[side]}"] + [f"--ink-{k}:{colours[side]}"
                                                   for k, colours in enumerate(palette)])
             for side in (0, 1)]
    head = (f"<title>Errors of {len(errors[0])} rows before and after calibration "
            f"({unused} rows set aside)</title>\n<style>:root{{{sides[0]}}}"
            f"@media(prefers-color-scheme:dark){{:root{{{sides[1]}}}}}</style>\n"
            '<rect width="100%" height="100%" rx="8" fill="var(--paper)"/>\n')
    return re.sub(r"(<svg[^>]*>\n*)", lambda found: found[1] + head, svg, count=1)


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__.strip())
    try:
        errors, unused = errors_of(pathlib.Path(arguments[0], "residuals.csv"))
        drawing = subprocess.run(["gnuplot"], input=script_of(errors), capture_output=True,
                                 text=True, check=True).stdout
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"picture: {error!r}: RESULT_FOLDER needs the residuals.csv of a run that found "
                 "effects in positions, and this machine needs gnuplot")
    except subprocess.CalledProcessError as error:
        sys.exit(f"picture: gnuplot failed: {error.stderr}")
    pathlib.Path(arguments[1]).write_text(finished(drawing, errors, unused), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
