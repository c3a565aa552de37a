"""Tests that tools/check_layers.py finds what it is there to find, each on a small tree of its own."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tools/
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

import check_layers  # noqa: E402  (its folder had to be made known first)

# A tree that keeps all rules.
CLEAN = {
    "core/base/status.h": "#pragma once\n#include <string>\n",
    "core/math/rotation.h": '#pragma once\n#include "core/base/status.h"\n',
    "core/report/text.h": '#pragma once\n#include "core/math/rotation.h"\n',
    "residuals/position.h": '#pragma once\n#include "core/report/text.h"\n',
    "problems/task.cc": '#include "residuals/position.h"\n#include "core/math/rotation.h"\n',
    "tools/support/cli.h": '#pragma once\n#include "core/base/status.h"\n',
    "tools/main.cc": '#include "tools/support/cli.h"\n',
    "tools/proof/simulator/truth.h": '#pragma once\n#include "core/base/status.h"\n',
    "tools/proof/suite.cc": '#include "tools/proof/simulator/truth.h"\n',
    "tools/proof/score.h": "#pragma once\n",
    "tools/study/draws.cc": '#include "residuals/position.h"\n',
    "tests/core/math/rotation_test.cc": '#include "core/math/rotation.h"\n#include <gtest/gtest.h>\n',
    "tests/tools/cli_test.cc": '#include "tools/support/cli.h"\n',
}


def run(folder):
    """Returns (exit status, output) of the check on a folder."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
        status = check_layers.main([folder])
    return status, output.getvalue()


def check(changes):
    """Returns (exit status, output) of the check on the clean tree with some files changed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **changes}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return run(folder)


class CheckLayersTest(unittest.TestCase):
    def expect_violation(self, name, text, *expected):
        status, output = check({name: text})
        self.assertEqual(status, 1, output)
        for part in expected:
            self.assertIn(part, output)
        self.assertIn("1 violations", output)

    def test_accepts_a_clean_tree(self):
        status, output = check({})
        self.assertEqual(status, 0, output)
        self.assertIn(f"{len(CLEAN)} files keep to the layers", output)

    def test_rejects_a_proof_that_shares_code_with_what_it_judges(self):
        for name in ("tools/proof/simulator/truth.cc", "tools/proof/score.cc"):
            for target in ("core/math/rotation.h", "residuals/position.h"):
                self.expect_violation(name, f'#include "{target}"\n', "may include only tools/proof/")

    def test_rejects_a_simulator_that_knows_how_it_is_scored(self):
        text = '#include "tools/proof/score.h"\n'
        rule = "tools/proof/simulator/ may include only tools/proof/simulator/"
        self.expect_violation("tools/proof/simulator/truth.cc", text, rule)

    def test_rejects_an_include_between_the_rooms_of_tools(self):
        text = '#include "tools/support/cli.h"\n'
        rule = "tools/study/ may not include another room of tools"
        self.expect_violation("tools/study/draws.h", text, "tools/study/draws.h:1:", rule)

    def test_rejects_core_that_includes_residuals(self):
        text = '#pragma once\n\n#include "residuals/position.h"\n'
        rule = "core/ may not include residuals/"
        self.expect_violation("core/base/bad.h", text, "core/base/bad.h:3:", rule)

    def test_rejects_problems_that_include_tools(self):
        text = '#include "tools/support/cli.h"\n'
        rule = "problems/ may not include tools/"
        self.expect_violation("problems/bad.cc", text, "problems/bad.cc:1:", rule)

    def test_rejects_tools_that_include_tests(self):
        changes = '#include "tests/support/matchers.h"\n'
        status, output = check({"tools/bad.cc": changes, "tests/support/matchers.h": "\n"})
        self.assertEqual(status, 1, output)
        self.assertIn("tools/ may not include tests/", output)

    def test_rejects_an_upward_arrow_inside_core(self):
        text = '#include "core/report/text.h"\n'
        rule = "core/math/ may not include core/report/"
        self.expect_violation("core/math/bad.cc", text, "core/math/bad.cc:1:", rule)

    def test_rejects_an_upward_arrow_from_a_folder_further_down(self):
        text = '#include "core/report/text.h"\n'
        rule = "core/physics/ may not include core/report/"
        self.expect_violation("core/physics/effects/bad.cc", text, rule)

    def test_rejects_an_unknown_folder_of_core(self):
        self.expect_violation("core/misc/bad.h", "#pragma once\n", "core/misc/bad.h:1:", "sub-folders")
        self.expect_violation("core/bad.h", "#pragma once\n", "core/bad.h:1:", "sub-folders")

    def test_rejects_an_include_that_is_not_from_the_root(self):
        rule = "not written from the repository root"
        self.expect_violation("core/math/bad.h", '#include "rotation.h"\n', "bad.h:1:", rule)
        self.expect_violation("core/math/bad.h", '#include "../base/status.h"\n', rule)
        self.expect_violation("core/math/bad.h", '#include "core/../core/base/status.h"\n', rule)

    def test_rejects_an_include_that_does_not_exist(self):
        self.expect_violation("core/math/bad.h", '#  include "core/base/no.h"\n', "does not exist")

    def test_rejects_angle_brackets_around_a_project_file(self):
        rule = 'write #include "core/base/status.h"'
        self.expect_violation("core/math/bad.h", "#include <core/base/status.h>\n", rule)

    def test_rejects_a_file_over_the_limit_only(self):
        self.expect_violation("core/math/bad.cc", "\n" * 401, "bad.cc:401:", "401 lines")
        status, output = check({"core/math/good.cc": "\n" * 400})
        self.assertEqual(status, 0, output)

    def test_ignores_an_include_in_a_comment(self):
        status, output = check({"core/math/good.cc": '// #include "tools/main.cc"\n'})
        self.assertEqual(status, 0, output)

    def test_refuses_a_folder_without_layers(self):
        with tempfile.TemporaryDirectory() as folder:
            status, output = run(folder)
        self.assertEqual(status, 2, output)


if __name__ == "__main__":
    unittest.main()
