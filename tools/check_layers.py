#!/usr/bin/env python3
"""Checks that the #includes run one way, and that no file grows too long.

usage: tools/check_layers.py [ROOT]

Reads every .h and .cc file below ROOT (default: this repository) and reports, as file:line, each
  * include that runs back up between layers:   core <- residuals <- problems <- tools, tests see all
  * include that runs back up inside core:      each sub-folder may include those before it
  * include between the rooms of tools:         each sub-folder may include only itself
  * include by tools/proof of the code that it is there to judge
  * include of a project file that is not written from the repository root
  * file that is longer than the limit
Exit status: 0 = nothing found, 1 = something found, 2 = ROOT is not such a tree.
"""

import pathlib
import re
import sys

# Each layer, and each sub-folder of core, may include itself and those before it.
LAYERS = ["core", "residuals", "problems", "tools", "tests"]
CORE = ["base", "simd", "math", "io", "model", "kinematics", "physics", "solver", "analysis", "report"]
MAX_LINES = 400

# The proof shares nothing with the identification that it judges, and its simulator nothing with
# those who score: folder -> the beginnings of what it may include.
SEALED_OFF = {
    "tools/proof/": ("tools/proof/", "core/base/", "core/io/csv_text.h"),
    "tools/proof/simulator/": ("tools/proof/simulator/", "core/base/", "core/io/csv_text.h"),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def layer_rule(includer, included):
    """Returns the rule that an include between two layers breaks, or None."""
    if LAYERS.index(included) <= LAYERS.index(includer):
        return None
    return f"{includer}/ may not include {included}/ (order: {' <- '.join(LAYERS)})"


def core_rule(includer, included):
    """Returns the rule that an include between two sub-folders of core breaks, or None."""
    if CORE.index(included) <= CORE.index(includer):
        return None
    return f"core/{includer}/ may not include core/{included}/ (order: {' <- '.join(CORE)})"


def room_rule(path, target):
    """Returns the rule that an include between two rooms of tools breaks, or None."""
    room = "/".join(path.parts[:2]) + "/"
    if path.parts[0] != "tools" or len(path.parts) < 3 or not target.startswith("tools/"):
        return None
    return None if target.startswith(room) else f"{room} may not include another room of tools"


def sealed_off_rule(path, target):
    """Returns the rule that an include out of a folder that is sealed off breaks, or None."""
    for folder, allowed in SEALED_OFF.items():
        if path.as_posix().startswith(folder) and not target.startswith(allowed):
            return f"{folder} may include only {', '.join(allowed)}"
    return None


def include_rule(root, path, quote, target):
    """Returns the rule that `#include <quote>target` in the file `path` breaks, or None."""
    parts = target.split("/")
    if quote == "<":
        if parts[0] in LAYERS and (root / target).is_file():
            return f'<{target}> is a file of this project: write #include "{target}"'
        return None
    if parts[0] not in LAYERS or ".." in parts or "." in parts:
        return f'"{target}" is not written from the repository root, as in "core/math/rotation.h"'
    if not (root / target).is_file():
        return f'"{target}" does not exist (paths are written from the repository root)'
    rule = (
        layer_rule(path.parts[0], parts[0])
        or sealed_off_rule(path, target)
        or room_rule(path, target)
    )
    if rule or path.parts[0] != "core" or parts[0] != "core" or parts[1] not in CORE:
        return rule
    # The file at hand is in a known sub-folder, or file_rules says that it is not.
    return core_rule(path.parts[1], parts[1]) if path.parts[1] in CORE else None


def file_rules(path, lines):
    """Yields (line, rule) for what is wrong with a file as a whole."""
    if path.parts[0] == "core" and path.parts[1] not in CORE:
        yield 1, f"core/ holds code only in the sub-folders {', '.join(CORE)}"
    if len(lines) > MAX_LINES:
        yield MAX_LINES + 1, f"{len(lines)} lines; a file may have {MAX_LINES}: split it"


def check_file(root, path):
    """Returns the messages about one file; `path` is relative to `root`."""
    lines = (root / path).read_text(encoding="utf-8").splitlines()
    found = list(file_rules(path, lines))
    for number, line in enumerate(lines, start=1):
        match = INCLUDE.match(line)
        rule = include_rule(root, path, *match.groups()) if match else None
        if rule:
            found.append((number, rule))
    return [f"{path}:{number}: {rule}" for number, rule in sorted(found)]


def source_files(root):
    """Returns the .h and .cc files of the layers, relative to `root`, in order."""
    return sorted(
        path.relative_to(root)
        for layer in LAYERS
        for path in (root / layer).rglob("*")
        if path.suffix in (".h", ".cc") and path.is_file()
    )


def main(arguments):
    if len(arguments) > 1 or arguments[:1] in (["--help"], ["-h"]):
        print(__doc__.strip())
        return 0 if len(arguments) == 1 else 2
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    if not any((root / layer).is_dir() for layer in LAYERS):
        print(f"check_layers: {root} holds none of {', '.join(LAYERS)}", file=sys.stderr)
        return 2
    files = source_files(root)
    messages = [message for path in files for message in check_file(root, path)]
    for message in messages:
        print(message)
    if messages:
        print(f"check_layers: {len(messages)} violations in {len(files)} files.")
        return 1
    print(f"check_layers: {len(files)} files keep to the layers.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
