"""Reads the commands of a page and walks them as its reader would, in a scratch folder.

What the fenced blocks of a page mean:

  sh               commands, run in order. Each must end with exit status 0, or with the one that a
                   comment behind it states: `ceres_dhcal --problem wrong.yaml  # exit status 1`
  sh long          commands that take longer than a test may: run only with DHCAL_GUIDES_LONG set
  sh needs=NAME    skipped, with a message, where NAME is neither a set variable nor a program
  (no language)    lines that the commands of the block before print, one after the other. `...`
                   stands for anything: in a line, or as a line for lines left out. A number stands
                   for all that round to its digits
  text             shown only: a record of what was printed once, by the commit that the page names
  any other        a file, if its first line is a comment with nothing but the file's name

Words behind the language are not shown where pages are rendered.
"""

import dataclasses
import difflib
import os
import pathlib
import re
import shutil
import signal
import subprocess
from decimal import Decimal

FENCE = re.compile(r"^(?P<indent> *)```(?P<words>[^`]*)$")
FILE_NAME = re.compile(r"^#\s*([\w./-]+\.\w+)\s*$")
STATED_STATUS = re.compile(r"\s+#\s*exit status (\d+)\s*$")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
SECONDS_PER_COMMAND = 60


class GuideError(AssertionError):
    """What a page says is not so."""


@dataclasses.dataclass
class Block:
    """A fenced block: the line of its fence (from 1), its language and words, its lines."""

    line: int
    language: str
    words: list
    lines: list


def blocks_of(text):
    """The fenced blocks of a page. Raises GuideError where a fence does not end."""
    blocks, open_block, indent = [], None, ""
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if open_block is None and fence:
            language, *words = fence["words"].split() or [""]
            open_block, indent = Block(number, language, words, []), fence["indent"]
        elif open_block is not None and line.strip() == "```":
            blocks.append(open_block)
            open_block = None
        elif open_block is not None:
            open_block.lines.append(line.removeprefix(indent))
    if open_block is not None:
        raise GuideError(f"line {open_block.line}: this block does not end")
    return blocks


def commands_of(block):
    """(command, exit status that it must have) of each line; a backslash joins lines."""
    for line in "\n".join(block.lines).replace("\\\n", " ").splitlines():
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        stated = STATED_STATUS.search(line)
        yield STATED_STATUS.sub("", line).strip(), int(stated[1]) if stated else 0


def same_number(quoted, printed):
    """Whether what was printed rounds to the digits quoted."""
    last_digit = Decimal(1).scaleb(Decimal(quoted).as_tuple().exponent)
    return abs(Decimal(quoted) - Decimal(printed)) <= last_digit / 2


def same_line(quoted, printed):
    """Whether a printed line is the quoted one, numbers to the digits quoted; blanks are alike."""
    pattern, numbers, end = "", [], 0
    quoted, printed = " ".join(quoted.split()), " ".join(printed.split())
    for found in re.finditer(NUMBER.pattern + r"|\.\.\.", quoted):
        pattern += re.escape(quoted[end:found.start()])
        end = found.end()
        if found[0] == "...":
            pattern += ".*?"
        else:
            numbers.append(found[0])
            pattern += f"({NUMBER.pattern})"
    match = re.fullmatch(pattern + re.escape(quoted[end:]), printed)
    return match is not None and all(map(same_number, numbers, match.groups()))


def line_not_printed(quoted, output):
    """The first quoted line that the output does not have where it should; None = it has all."""
    printed = [line for line in output.splitlines() if line.strip()]
    parts = [[]]
    for line in quoted:
        if line.strip() == "...":
            parts.append([])
        elif line.strip():
            parts[-1].append(line)
    start = 0
    for part in parts:
        furthest = 0
        for first in range(start, len(printed) + 1):
            there = 0
            while (there < len(part) and first + there < len(printed)
                   and same_line(part[there], printed[first + there])):
                there += 1
            furthest = max(furthest, there)
            if there == len(part):
                start = first + there
                break
        else:
            return part[furthest]
    return None


def why_skipped(block, environment):
    """Why this machine, or a test, does not run the block; empty = it does."""
    for word in block.words:
        name = word.removeprefix("needs=")
        if word == "long":
            if not environment.get("DHCAL_GUIDES_LONG"):
                return "takes long; set DHCAL_GUIDES_LONG=1 to run it"
        elif name == word:
            raise GuideError(f"line {block.line}: '{word}' means nothing: long or needs=NAME")
        elif not environment.get(name) and not shutil.which(name, path=environment["PATH"]):
            return f"needs {name}"
    return ""


def write_file(block, folder):
    """Writes the file that a block shows, if its first line names one."""
    named = FILE_NAME.match(block.lines[0]) if block.lines else None
    if named:
        path = pathlib.Path(folder, named[1])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(block.lines) + "\n", encoding="utf-8")


def run_command(command, folder, environment, seconds):
    """(exit status, what it printed); the status is None where it took longer than that."""
    with subprocess.Popen(["bash", "-euo", "pipefail", "-c", command], cwd=folder, env=environment,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace",
                          start_new_session=True) as run:
        try:
            output, _ = run.communicate(timeout=seconds)
            return run.returncode, output
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)  # with all that it started
            output, _ = run.communicate()
            return None, output


def run_block(block, folder, environment):
    """What its commands print. Raises GuideError where one does not end as stated."""
    printed = ""
    for command, status in commands_of(block):
        seconds = None if "long" in block.words else SECONDS_PER_COMMAND
        ended, output = run_command(command, folder, environment, seconds)
        printed += output
        if ended is None:
            raise GuideError(f"line {block.line}: '{command}' takes more than {seconds} s")
        if ended != status:
            raise GuideError(f"line {block.line}: '{command}' ended with {ended}, the page says "
                             f"{status}. It printed:\n{output}")
    return printed


def walk(text, folder, environment=None):
    """Does in the folder what the page says. Returns what was skipped, as messages; raises
    GuideError at the first thing that is not as the page says."""
    environment = dict(environment or os.environ)
    skipped, output, skipping = [], "", None
    for block in blocks_of(text):
        if block.language == "sh":
            skipping = why_skipped(block, environment)
            if skipping:
                skipped.append(f"line {block.line}: {skipping}")
            else:
                output = run_block(block, folder, environment)
        elif block.language:
            write_file(block, folder)
        elif skipping is None:
            raise GuideError(f"line {block.line}: no command stands before this output")
        elif not skipping:
            missing = line_not_printed(block.lines, output)
            if missing is not None:
                near = difflib.get_close_matches(missing, output.splitlines(), n=1, cutoff=0.0)
                raise GuideError(f"line {block.line}: the commands above did not print, where it "
                                 f"should stand:\n{missing}\nThe line most like it that they "
                                 f"printed:\n{near[0] if near else ''}")
    return skipped
