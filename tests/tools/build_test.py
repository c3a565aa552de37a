"""Tests what the build promises to whoever configures it: python3 build_test.py CMAKE [TEST...]

Each test configures the project, all build types at once, and reads the compile commands.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CMAKE = "cmake"


def compile_commands(*options):
    """Returns {build type: {source relative to the project: words of its compile command}}."""
    clean = {name: value for name, value in os.environ.items() if not name.endswith("FLAGS")}
    with tempfile.TemporaryDirectory() as build:
        subprocess.run(
            [CMAKE, "-S", ROOT, "-B", build, "-G", "Ninja Multi-Config",
             "-DCMAKE_CONFIGURATION_TYPES=Release;RelWithDebInfo", "-DDHCAL_BUILD_TESTS=OFF",
             *options],
            check=True, capture_output=True, env=clean)
        text = pathlib.Path(build, "compile_commands.json").read_text(encoding="utf-8")
    found = {"Release": {}, "RelWithDebInfo": {}}
    for entry in json.loads(text):
        words = entry["command"].split()
        build_type = next(name for name in found if f"{os.sep}{name}{os.sep}" in words[-3])
        found[build_type][os.path.relpath(entry["file"], ROOT)] = words
    return found


def camera_tool_among(commands):
    return [source for source in commands
            if source.startswith(("tools/camera/", "tools/dhcal_ruler", "tests/tools/camera/"))]


class BuildTest(unittest.TestCase):
    def expect_flags(self, commands, wanted, unwanted):
        self.assertIn("tools/ceres_dhcal.cc", commands)
        for source, words in commands.items():
            for flag in wanted:
                self.assertIn(flag, words, source)
            for flag in unwanted:
                self.assertNotIn(flag, words, source)

    def test_optimises_and_keeps_assertions_outside_of_release(self):
        commands = compile_commands()
        self.expect_flags(commands["Release"], ["-O3", "-DNDEBUG"], ["-g"])
        self.expect_flags(commands["RelWithDebInfo"], ["-O2", "-g"], ["-DNDEBUG", "-O3"])

    def test_keeps_the_flags_of_the_command_line(self):
        commands = compile_commands(
            "-DCMAKE_CXX_FLAGS=-fstack-protector-strong",
            "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
            "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-Og")
        for build_type, flag in (("Release", "-O1"), ("RelWithDebInfo", "-Og")):
            self.expect_flags(
                commands[build_type],
                [flag, "-fstack-protector-strong"],
                ["-O2", "-O3", "-DNDEBUG", "-g"])

    def test_needs_nothing_that_only_tests_need(self):
        without = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("GTest", "OpenSSL", "Python3")]
        commands = compile_commands(*without)["Release"]
        self.assertIn("tools/dhcal_study.cc", commands)
        self.assertFalse([source for source in commands if "prove" in source or "proof" in source])

    def test_needs_no_camera(self):
        commands = compile_commands("-DDHCAL_CAMERA=OFF")["Release"]
        self.assertIn("tools/ceres_dhcal.cc", commands)
        self.assertFalse(camera_tool_among(commands))
        nowhere = compile_commands("-DOPENCV_INCLUDE_DIR=OPENCV_INCLUDE_DIR-NOTFOUND",
                                   "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON",
                                   "-DCMAKE_IGNORE_PATH=/usr/include/opencv4")["Release"]
        self.assertFalse(camera_tool_among(nowhere))


if __name__ == "__main__":
    CMAKE = sys.argv.pop(1)
    unittest.main()
