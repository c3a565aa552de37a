#!/usr/bin/env python3
"""Checks that every document and section that is cited exists.

usage: tools/check_citations.py [ROOT]

Reads every text file of the repository below ROOT (default: this one) and reports, as file:line, each
  * name of a Markdown document (core/NOTATION.md, PHYSICS.md) that is none of the repository's: as a
    path from the root or from the citing file's folder, or by its name where only one has it
  * label behind such a name (PHYSICS.md E4; PHYSICS.md G1-G3, B1) that is no heading's in it
  * section behind such a name (FORMATS.md, section 2) that is no heading's in it
Exit status: 0 = nothing found, 1 = something found, 2 = ROOT holds no document.
"""

import pathlib
import re
import sys

SUFFIXES = (".h", ".cc", ".py", ".md", ".sh", ".cmake", ".yaml", ".txt")
SKIPPED = ("build/", ".git/", "tests/data/")  # the last: files that are broken on purpose
# Citations in these are examples, or wrong on purpose.
OWN = ("tools/check_citations.py", "tests/tools/check_citations_test.py")

# A document's name that is not part of a web address.
DOCUMENT = re.compile(r"(?<![\w/.:-])((?:[\w.-]+/)*[\w-]+\.md)\b")
LABEL = r"[A-Z]\d+"
RANGE = rf"{LABEL}(?:-{LABEL})?"
LABELS = re.compile(rf"[\s,()]*({RANGE}(?:(?:,| and|,? or)\s+{RANGE})*)\b")
SECTION = re.compile(r",?\s+section\s+(\d+)\b")
# A line's end with what begins the next line of a comment, or parts two strings of C++.
CONTINUATION = re.compile(r'(?:"\s*\n\s*")|(?:\s*\n[ \t]*(?://+|#)?[ \t]*)')
HEADING = re.compile(rf"^#+\s+({LABEL}|\d+)\b", re.MULTILINE)


def text_files(root):
    """Returns the text files of the repository, relative to `root`, in order."""
    return sorted(
        path.relative_to(root)
        for path in root.rglob("*")
        if path.suffix in SUFFIXES
        and path.is_file()
        and not path.relative_to(root).as_posix().startswith(SKIPPED)
    )


def find_document(root, citing, name, documents):
    """Returns the document that `name` means in the file `citing`, or None."""
    for folder in (root, (root / citing).parent):
        path = (folder / name).resolve()
        if path.is_file() and root in path.parents:
            return path.relative_to(root)
    same_name = [path for path in documents if "/" not in name and path.name == name]
    return same_name[0] if len(same_name) == 1 else None


def expand(labels):
    """Returns ["G1", "G2", "G3", "B1"] for "G1-G3, B1"."""
    expanded = []
    for part in re.findall(RANGE, labels):
        first, _, last = part.partition("-")
        if not last:
            expanded.append(first)
        elif first[0] != last[0]:
            expanded += [first, last]
        else:
            expanded += [f"{first[0]}{n}" for n in range(int(first[1:]), int(last[1:]) + 1)]
    return expanded


def one_line(text):
    """Returns the text without line breaks, and for each character of it the line it stood on."""
    joined, lines, position = [], [], 0
    for match in [*CONTINUATION.finditer(text), None]:
        part = text[position : match.start() if match else len(text)]
        line = text.count("\n", 0, position) + 1
        for character in part:
            joined.append(character)
            lines.append(line)
            line += character == "\n"
        if match:
            joined.append(" ")
            lines.append(line)
            position = match.end()
    return "".join(joined), lines


def check_file(root, path, documents, headings):
    """Returns the messages about one file; `path` is relative to `root`."""
    text, lines = one_line((root / path).read_text(encoding="utf-8"))
    messages = []
    for match in DOCUMENT.finditer(text):
        name, line = match.group(1), lines[match.start()]
        document = find_document(root, path, name, documents)
        if document is None:
            messages.append(f"{path}:{line}: {name} is no document of the repository")
            continue
        labels = LABELS.match(text, match.end())
        section = SECTION.match(text, match.end())
        cited = expand(labels.group(1)) if labels else [section.group(1)] if section else []
        for label in cited:
            if label not in headings[document]:
                messages.append(f"{path}:{line}: {document} has no section {label}")
    return messages


def main(arguments):
    if len(arguments) > 1 or arguments[:1] in (["--help"], ["-h"]):
        print(__doc__.strip())
        return 0 if len(arguments) == 1 else 2
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parent.parent).resolve()
    files = text_files(root)
    documents = [path for path in files if path.suffix == ".md"]
    if not documents:
        print(f"check_citations: {root} holds no document", file=sys.stderr)
        return 2
    headings = {
        path: set(HEADING.findall((root / path).read_text(encoding="utf-8"))) for path in documents
    }
    messages = [
        message
        for path in files
        if path.as_posix() not in OWN
        for message in check_file(root, path, documents, headings)
    ]
    for message in messages:
        print(message)
    if messages:
        print(f"check_citations: {len(messages)} citations of what does not exist.")
        return 1
    print(f"check_citations: all that {len(files)} files cite exists.")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
