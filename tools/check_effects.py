#!/usr/bin/env python3
"""Checks that no file but an effect's own knows it by name.

usage: tools/check_effects.py [ROOT]

An effect is a file core/physics/effects/NAME.cc and a line of core/physics/registry.cc. What the
rest of the program must know of it stands in its description (core/physics/effect.h). Reports, as
file:line, each file below ROOT (default: this repository) of core, residuals, problems and tools
that names one all the same, and each effect without its line. May name effects: the effect's own
file, tests, problem files (.yaml), texts (.md), and those that make recordings with known causes
(problems/concealed, tools/support).
A name without an underscore is a word of English, so it counts only as a text of its own.
Exit status: 0 = nothing found, 1 = something found, 2 = ROOT is not such a tree.
"""

import pathlib
import re
import sys

LAYERS = ["core", "residuals", "problems", "tools"]
SUFFIXES = (".h", ".cc", ".py", ".sh", ".cmake")
EFFECTS = pathlib.Path("core/physics/effects")
REGISTRY = pathlib.Path("core/physics/registry.cc")
MAKE_CAUSES = (pathlib.Path("problems/concealed"), pathlib.Path("tools/support"))


def pattern_of(name):
    """Returns the expression that finds a name in a line."""
    return re.compile(rf"\b{name}\b" if "_" in name else rf'"{name}"')


def function_of(name):
    """Returns the name of the function that an effect's file defines: SomeEffect for some_effect."""
    return "".join(part.capitalize() for part in name.split("_"))


def may_name(path, name):
    """True if the file `path` may name the effect `name`."""
    if path.parent == EFFECTS and path.stem == name:
        return True
    return any(folder in path.parents for folder in MAKE_CAUSES)


def source_files(root):
    """Returns the files of the layers that are checked, relative to `root`, in order."""
    return sorted(
        path.relative_to(root)
        for layer in LAYERS
        for path in (root / layer).rglob("*")
        if path.suffix in SUFFIXES and path.is_file()
    )


def check_file(root, path, patterns):
    """Returns the messages about one file."""
    messages = []
    for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), start=1):
        for name, pattern in patterns.items():
            if pattern.search(line) and not may_name(path, name):
                messages.append(f"{path}:{number}: names the effect {name}; ask its description")
    return messages


def check_registry(root, names):
    """Returns the messages about effects without a line in the registry."""
    text = (root / REGISTRY).read_text(encoding="utf-8")
    return [
        f"{EFFECTS / name}.cc:1: no line DHCAL_EFFECT({function_of(name)}) in {REGISTRY}"
        for name in names
        if f"DHCAL_EFFECT({function_of(name)})" not in text
    ]


def main(arguments):
    if len(arguments) > 1 or arguments[:1] in (["--help"], ["-h"]):
        print(__doc__.strip())
        return 0 if len(arguments) == 1 else 2
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    if not (root / EFFECTS).is_dir() or not (root / REGISTRY).is_file():
        print(f"check_effects: {root} holds no {EFFECTS} with a {REGISTRY}", file=sys.stderr)
        return 2
    names = sorted(path.stem for path in (root / EFFECTS).glob("*.cc"))
    patterns = {name: pattern_of(name) for name in names}
    files = source_files(root)
    messages = check_registry(root, names)
    messages += [message for path in files for message in check_file(root, path, patterns)]
    for message in messages:
        print(message)
    if messages:
        print(f"check_effects: {len(messages)} violations in {len(files)} files.")
        return 1
    print(f"check_effects: {len(names)} effects, named in no file of {len(files)} but their own.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
