"""Tests that guide_walk.py notices a page that is wrong, each on a page of its own."""

import os
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tests/
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from guide_walk import GuideError, walk  # noqa: E402  (its folder had to be made known first)


def walk_lines(*lines, **environment):
    with tempfile.TemporaryDirectory() as folder:
        return walk("\n".join(lines), folder, {"PATH": os.environ["PATH"], **environment})


class GuideWalkTest(unittest.TestCase):
    def expect_wrong(self, *lines, says):
        with self.assertRaisesRegex(GuideError, says):
            walk_lines(*lines)

    def test_a_command_that_fails_is_noticed(self):
        self.expect_wrong("Text", "```sh", "true", "false", "```",
                          says="line 2: 'false' ended with 1")

    def test_a_command_that_does_not_exist_is_noticed(self):
        self.expect_wrong("```sh", "ceres_dhcall --problem a", "```", says="ended with 127")

    def test_a_failure_inside_a_pipe_is_noticed(self):
        self.expect_wrong("```sh", "false | cat", "```", says="ended with 1")

    def test_a_stated_exit_status_must_come(self):
        walk_lines("```sh", "exit 3  # exit status 3", "```")
        self.expect_wrong("```sh", "exit 2  # exit status 3", "```", says="the page says 3")
        self.expect_wrong("```sh", "true  # exit status 1", "```", says="ended with 0")

    def test_commands_leave_files_for_those_after_them(self):
        walk_lines("```sh", "echo 1 > a", "```", "", "1. Then",
                   "   ```sh", "   grep 1 \\", "     a", "   ```")

    def test_a_file_that_is_announced_must_be_there(self):
        self.expect_wrong("```sh", "touch a", "ls", "```", "```", "a", "b", "```", says="\nb\n")

    def test_blocks_that_name_a_file_are_written(self):
        walk_lines("```yaml", "# a.yaml", "x: 1", "```", "```sh", "grep x a.yaml", "```")
        self.expect_wrong("```yaml", "x: 1", "```", "```sh", "cat a.yaml", "```",
                          says="ended with 1")

    def test_figures_are_held_to_the_digits_quoted(self):
        said = ("```sh", "echo 'RMS 0.4394 mm, -2.5e-3 rad (p < 1e-99)'", "```")
        for quoted in ["RMS 0.4394 mm, -2.5e-3 rad (p < 1e-99)",
                       "RMS 0.44 mm, -2.5e-3 rad (p < 1e-99)", "RMS  0.439 ..."]:
            walk_lines(*said, "```", quoted, "```")
        for quoted in ["RMS 0.4395 mm, -2.5e-3 rad (p < 1e-99)", "RMS 0.45 mm, ...",
                       "RMS 0.4394 mm", "RMS 0.4394 mm, 2.5e-3 ...", "RMS 0.4394 um, ..."]:
            self.expect_wrong(*said, "```", quoted, "```", says="did not print")

    def test_lines_stand_one_after_the_other(self):
        said = ("```sh", r"printf '  a\n\nb\nc\nd\n'", "```", "```")
        walk_lines(*said, "a", "b", "```", "More:", "```", "c", "```")
        walk_lines(*said, "a", "...", "d", "```")
        self.expect_wrong(*said, "a", "c", "```", says="\nc\n")
        self.expect_wrong(*said, "c", "...", "b", "```", says="\nb\n")

    def test_output_without_a_command_is_noticed(self):
        self.expect_wrong("```", "a", "```", says="no command")

    def test_a_block_without_end_is_noticed(self):
        self.expect_wrong("```sh", "true", says="line 1: this block does not end")

    def test_what_the_machine_lacks_is_skipped_and_said(self):
        page = ("```sh needs=NOT_THERE", "false", "```", "```", "a", "```", "```sh", "true", "```")
        self.assertEqual(walk_lines(*page), ["line 1: needs NOT_THERE"])
        with self.assertRaises(GuideError):
            walk_lines(*page, NOT_THERE="1")
        with self.assertRaises(GuideError):
            walk_lines("```sh needs=bash", "false", "```")

    def test_long_commands_run_only_when_asked_for(self):
        page = ("```sh long", "false", "```")
        self.assertEqual(len(walk_lines(*page)), 1)
        with self.assertRaises(GuideError):
            walk_lines(*page, DHCAL_GUIDES_LONG="1")

    def test_a_skip_of_an_earlier_block_excuses_no_other(self):
        self.expect_wrong("```sh long", "true", "```", "```sh", "echo b", "```", "```", "a", "```",
                          says="did not print")

    def test_a_misspelt_mark_is_noticed(self):
        self.expect_wrong("```sh lnog", "true", "```", says="'lnog' means nothing")


if __name__ == "__main__":
    unittest.main()
