"""Tests that tools/check_effects.py finds what it is there to find, each on a small tree of its own."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # leave no __pycache__ in tools/
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

import check_effects  # noqa: E402  (its folder had to be made known first)

# A tree that keeps the rule.
CLEAN = {
    "core/physics/registry.cc": "DHCAL_EFFECT(JointGain) \\\nDHCAL_EFFECT(Latency)\n",
    "core/physics/effects/joint_gain.cc": 'JointEffect({"joint_gain", ""})\n',
    "core/physics/effects/latency.cc": 'Effect({"latency"})\n',
    "core/physics/effect.h": "// The latency of a reading is an effect.\n",
    "problems/search.cc": 'request.settings["order"] = joint_gains;\n',
    "problems/concealed/causes.cc": 'Named("joint_gain")\n',
    "problems/case.yaml": "effects: [{effect: joint_gain}]\n",
    "problems/case.md": "joint_gain\n",
    "tools/support/scenarios.cc": 'Request("joint_gain")\n',
    "tests/problems/search_test.cc": 'Request("joint_gain")\n',
    "residuals/position.h": "\n",
}


def run(folder):
    """Returns (exit status, output) of the check on a folder."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
        status = check_effects.main([folder])
    return status, output.getvalue()


def check(changes):
    """Returns (exit status, output) of the check on the clean tree with some files changed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **changes}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return run(folder)


class CheckEffectsTest(unittest.TestCase):
    def expect_violation(self, name, text, expected):
        status, output = check({name: text})
        self.assertEqual(status, 1, output)
        self.assertIn(expected, output)
        self.assertIn("1 violations", output)

    def test_accepts_a_clean_tree(self):
        status, output = check({})
        self.assertEqual(status, 0, output)
        self.assertIn("2 effects", output)

    def test_finds_a_name_in_code_and_comments_of_every_layer(self):
        for name in ("core/io/a.cc", "residuals/a.h", "problems/diagnosis/a.cc", "tools/a.py"):
            self.expect_violation(name, '\nif (effect == "joint_gain") {}\n', f"{name}:2:")
            self.expect_violation(name, "// As joint_gain does.\n", "names the effect joint_gain")

    def test_finds_the_name_of_another_effect(self):
        name = "core/physics/effects/joint_gain.cc"
        self.expect_violation(name, '"joint_gain" "latency"\n', "names the effect latency")

    def test_takes_a_word_of_english_only_as_a_text_of_its_own(self):
        self.expect_violation("problems/a.cc", 'effect == "latency"\n', "problems/a.cc:1:")
        status, output = check({"problems/a.cc": "// The latency of the loop.\n"})
        self.assertEqual(status, 0, output)

    def test_finds_an_effect_without_its_line(self):
        self.expect_violation(
            "core/physics/effects/axis_tilt.cc", '"axis_tilt"\n', "DHCAL_EFFECT(AxisTilt)"
        )

    def test_refuses_a_folder_that_is_no_such_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run(folder)[0], 2)


if __name__ == "__main__":
    unittest.main()
