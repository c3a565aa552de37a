"""Checks that the objects of the SIMD kernels hold no code that other objects may hold, too.

usage: simd_objects_test.py OBJECT...

Of the objects given, those named kernels_* are looked at with nm. Each may define one global symbol,
its table of kernels, and nothing that a linker merges (inline functions, templates): the linker could
keep the copy that was compiled for another processor. See core/simd/SIMD.md.
"""

import pathlib
import re
import subprocess
import sys

LEVELS = {"kernels_baseline", "kernels_avx2", "kernels_avx512"}
TABLE = re.compile(r"^dhcal::simd::k\w+Kernels$")
# What nm prints: an address or none, a letter (upper case = global, V W u = merged), the name.
LINE = re.compile(r"^[0-9a-f ]*([A-Za-z]) (.*)$")


def foreign_symbols(listing):
    """Returns the symbols of nm's listing that the linker could give to, or take from, others."""
    found = [LINE.match(line).groups() for line in listing.splitlines()]
    defined = [name for kind, name in found if (kind.isupper() and kind != "U") or kind == "u"]
    return [name for name in defined if not TABLE.match(name)]


def main(objects):
    kernels = [path for path in map(pathlib.Path, objects) if path.name.startswith("kernels_")]
    missing = LEVELS - {path.name.split(".")[0] for path in kernels}
    if missing:
        sys.exit(f"no object of {', '.join(sorted(missing))} in {objects}")
    for path in kernels:
        nm = subprocess.run(["nm", "-C", path], check=True, capture_output=True, text=True)
        foreign = foreign_symbols(nm.stdout)
        if foreign:
            sys.exit(f"{path} defines {foreign}")
    # The check itself: an inline function is found.
    listing = "0000 W std::max(int, int)\n0000 T f()\n     U sin\n0000 t g()\n"
    if foreign_symbols(listing) != ["std::max(int, int)", "f()"]:
        sys.exit(f"the check is blind: {foreign_symbols(listing)}")
    print(f"{len(kernels)} objects hold nothing that the linker merges.")


if __name__ == "__main__":
    main(sys.argv[1:])
