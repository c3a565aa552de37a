"""Walks every page that has commands in blocks: python3 guides_test.py FOLDER PROGRAM...

FOLDER holds the built programs, the names after it are those that an installation has. The scratch
folder of a page looks like the top of the repository after a build, with those names on the PATH;
guide_walk.py says what blocks mean. Also: flags that pages name anywhere are in --help.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tests/
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from guide_walk import GuideError, blocks_of, commands_of, walk  # noqa: E402

PROGRAMS = pathlib.Path("build/release/bin")
INSTALLED = []
ROOT = pathlib.Path(__file__).resolve().parents[3]
WITHOUT_PAGES = ("build", "tests", "third_party_notes", ".git")
IN_TEXT = re.compile(r"`((?:build/release/bin/)?(?:ceres_dhcal|dhcal_\w+) [^`\n]*)`")
FLAG = re.compile(r"(?<![\w-])--([a-z][\w-]*)")


def pages():
    """Every page that has commands, and every guide."""
    for path in sorted(ROOT.rglob("*.md")):
        if path.relative_to(ROOT).parts[0] in WITHOUT_PAGES:
            continue
        has_commands = any(b.language == "sh" for b in blocks_of(path.read_text(encoding="utf-8")))
        if has_commands or path.parent == ROOT / "problems/guides":
            yield path


def scratch_of(folder):
    """Lays the repository's entries and the programs into the folder; returns the environment."""
    for entry in ROOT.iterdir():
        if entry.name not in ("build", ".git"):
            pathlib.Path(folder, entry.name).symlink_to(entry)
    release = pathlib.Path(folder, "build/release")
    release.mkdir(parents=True)
    (release / "bin").symlink_to(PROGRAMS)
    home = pathlib.Path(folder, "build/home")
    (home / "bin").mkdir(parents=True)
    for program in INSTALLED:
        (home / "bin" / program).symlink_to(PROGRAMS / program)
    return {**os.environ, "PATH": f"{home}/bin:{os.environ['PATH']}", "HOME": str(home),
            "LC_ALL": "C", "PYTHONDONTWRITEBYTECODE": "1"}


def unknown_flags(text):
    """Flags, also of blocks that are skipped, that --help does not name, as 'program --flag'."""
    in_blocks = [command for block in blocks_of(text) if block.language == "sh"
                 for command, _ in commands_of(block)]
    for command in IN_TEXT.findall(text) + in_blocks:
        program = pathlib.Path(command.split()[0]).name
        if not program.startswith(("ceres_", "dhcal_")) or not (PROGRAMS / program).exists():
            continue
        shown = subprocess.run([PROGRAMS / program, "--help"], capture_output=True, text=True,
                               check=False)
        known = {flag.replace("_", "-") for flag in FLAG.findall(shown.stdout + shown.stderr)}
        for flag in FLAG.findall(command):
            if flag.replace("_", "-") not in known | {"help", "version"}:
                yield f"{program} --{flag}"


class GuidesTest(unittest.TestCase):
    def test_there_are_pages_and_each_guide_has_commands(self):
        found = list(pages())
        self.assertIn(ROOT / "README.md", found)
        for path in found:
            blocks = blocks_of(path.read_text(encoding="utf-8"))
            self.assertTrue(any(b.language == "sh" for b in blocks), f"{path} shows no command")

    def test_flags_exist(self):
        self.assertEqual(list(unknown_flags("`ceres_dhcal --problm a`")), ["ceres_dhcal --problm"])
        self.assertEqual(list(unknown_flags("```sh long\ndhcal_plan --posses 3\n```")),
                         ["dhcal_plan --posses"])
        for path in pages():
            self.assertEqual(list(unknown_flags(path.read_text(encoding="utf-8"))), [], path)


def walk_of(path):
    def test(self):
        with tempfile.TemporaryDirectory() as folder:
            skipped, wrong = [], None
            try:
                skipped = walk(path.read_text(encoding="utf-8"), folder, scratch_of(folder))
            except GuideError as error:
                wrong = error
        self.assertIsNone(wrong, f"{path.relative_to(ROOT)}, {wrong}")
        for reason in skipped:
            print(f"skipped: {path.relative_to(ROOT)}, {reason}", file=sys.stderr)
    return test


for page in pages():
    name = re.sub(r"\W+", "_", str(page.relative_to(ROOT).with_suffix("")))
    setattr(GuidesTest, f"test_page_{name}", walk_of(page))


if __name__ == "__main__":
    PROGRAMS, INSTALLED = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    unittest.main(argv=sys.argv[:1])
