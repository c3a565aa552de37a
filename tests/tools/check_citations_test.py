"""Tests that tools/check_citations.py finds what it is there to find, each on a small tree of its own."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tools/
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

import check_citations  # noqa: E402  (its folder had to be made known first)

# A tree whose citations all exist.
CLEAN = {
    "README.md": "See [the page](core/physics/PHYSICS.md), and https://example.org/other/GONE.md.\n",
    "core/physics/PHYSICS.md": "# Physics\n## Elastic\n### E1 Joints\n### E2 Springs\n### E3 Links\n### C8 Mesh\n",
    "problems/FORMATS.md": "# Formats\n## 1 The recording\n## 2 The problem\n",
    "core/NOTATION.md": "See [PHYSICS.md](physics/PHYSICS.md).\n",
    "core/a.cc": "// Source: PHYSICS.md E1-E3, C8.\n// And (PHYSICS.md\n// E2; Somebody 1990). FORMATS.md, section 2.\n",
    "core/b.cc": 'const char* const kSource = "big [PHYSICS.md "\n                            "E1]";\n',
}


def check(changes):
    """Returns (exit status, output) of the check on the clean tree with some files changed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **changes}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            status = check_citations.main([folder])
        return status, output.getvalue()


class CheckCitationsTest(unittest.TestCase):
    def expect_finding(self, name, text, *expected):
        status, output = check({name: text})
        self.assertEqual(status, 1, output)
        for part in expected:
            self.assertIn(part, output)
        self.assertIn("1 citations", output)

    def test_accepts_what_exists(self):
        status, output = check({})
        self.assertEqual(status, 0, output)

    def test_finds_a_document_that_does_not_exist(self):
        self.expect_finding("core/c.h", "\n// See design.md.\n", "core/c.h:2: design.md is no document")

    def test_tells_upper_from_lower_case(self):
        self.expect_finding("core/c.h", "// physics.md E1\n", "physics.md is no document")

    def test_finds_a_path_that_does_not_exist(self):
        self.expect_finding("core/c.md", "[x](../NOTATION.md)\n", "../NOTATION.md is no document")

    def test_finds_a_label_that_no_heading_has(self):
        self.expect_finding("core/c.cc", "// PHYSICS.md E1, E4\n", "core/c.cc:1", "has no section E4")

    def test_finds_a_label_inside_a_range(self):
        self.expect_finding("core/c.cc", "// PHYSICS.md E2-E4\n", "has no section E4")

    def test_finds_a_label_on_the_next_line(self):
        self.expect_finding("core/c.cc", "//\n// Source: PHYSICS.md\n// E9.\n", "core/c.cc:2", "no section E9")

    def test_finds_a_label_in_the_next_string(self):
        self.expect_finding("core/c.cc", 'f("[PHYSICS.md "\n  "E9]");\n', "no section E9")

    def test_finds_a_section_that_does_not_exist(self):
        self.expect_finding("core/c.cc", "// (FORMATS.md, section 3)\n", "FORMATS.md has no section 3")

    def test_does_not_guess_between_documents_of_one_name(self):
        status, output = check({"problems/PHYSICS.md": "# Other\n"})
        self.assertEqual(status, 1)
        self.assertIn("core/a.cc:1: PHYSICS.md is no document", output)

    def test_refuses_a_tree_without_documents(self):
        with tempfile.TemporaryDirectory() as folder:
            output = io.StringIO()
            with contextlib.redirect_stderr(output):
                self.assertEqual(check_citations.main([folder]), 2)


if __name__ == "__main__":
    unittest.main()
