"""Tests an installation: python3 install_test.py CMAKE BUILD [TEST...]

Installs the build tree BUILD, moves what was installed, and uses it as others would.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE = "cmake"
BUILD = "build"
PROGRAMS = ["ceres_dhcal", "dhcal_simulate", "dhcal_compensate", "dhcal_compare",
            "dhcal_convert", "dhcal_plan"]

CONSUMER_CMAKE = """
cmake_minimum_required(VERSION 3.22)
project(consumer CXX)
find_package(ceres_dhcal 0.1 REQUIRED)
add_executable(consumer main.cc)
target_link_libraries(consumer PRIVATE ceres_dhcal::problems)
"""

# The flange of the UR5e at all zero, as its teach pendant shows it: -817.2, -232.9, 62.8 mm.
CONSUMER_SOURCE = """
#include <iostream>
#include "core/kinematics/dh_chain.h"
#include "problems/formats/problem/problem_reader.h"

int main(int, char** argv) {
  dhcal::Diagnostics diagnostics;
  const auto spec = dhcal::ReadProblemFile(argv[1], "", &diagnostics);
  if (!spec) return 1;
  const dhcal::DhChain chain(spec->robot);
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  std::cout << 1e3 * chain.LinkFrames(q).back().translation().transpose();
}
"""


def run(*words, cwd=None):
    done = subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class InstallTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        scratch = pathlib.Path(cls.scratch.name)
        run(CMAKE, "--install", BUILD, "--prefix", scratch / "first")
        cls.prefix = scratch / "moved"
        # Of an optional part, where it was built.
        cls.programs = PROGRAMS + [name for name in ["dhcal_ruler"]
                                   if pathlib.Path(BUILD, "bin", name).exists()]
        (scratch / "first").rename(cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_programs_run_from_where_they_were_moved(self):
        for program in self.programs:
            self.assertIn(program, run(self.prefix / "bin" / program, "--help"))
        self.assertFalse((self.prefix / "bin" / "dhcal_prove").exists())

    def test_init_finds_its_own_templates(self):
        with tempfile.TemporaryDirectory() as work:
            template = self.prefix / "share/ceres_dhcal/robots/mine.yaml"
            shutil.copy(template.with_name("ur5e.yaml"), template)
            run(self.prefix / "bin/ceres_dhcal", "init", "mine", cwd=work)
            template.unlink()
            self.assertIn("Universal Robots UR5e", pathlib.Path(work, "problem.yaml").read_text())

    def test_the_guides_that_readme_links_are_there(self):
        doc = self.prefix / "share/doc/ceres-dhcal"
        readme = (doc / "README.md").read_text()
        links = re.findall(r"\]\((problems/(?:guides/|FORMATS)[^)#]*)", readme)
        self.assertGreater(len(links), 10)
        for link in links:
            self.assertTrue((doc / link).is_file(), link)

    def test_cases_of_the_package_run(self):
        with tempfile.TemporaryDirectory() as work:
            case = self.prefix / "share/ceres_dhcal/cases/kr15.yaml"
            run(self.prefix / "bin/ceres_dhcal", "--problem", case, "--quiet", cwd=work)
            self.assertTrue(pathlib.Path(work, "kr15_result/report.txt").exists())

    def test_another_project_links_the_libraries(self):
        with tempfile.TemporaryDirectory() as work:
            pathlib.Path(work, "CMakeLists.txt").write_text(CONSUMER_CMAKE)
            pathlib.Path(work, "main.cc").write_text(CONSUMER_SOURCE)
            run(CMAKE, "-S", work, "-B", f"{work}/b", "-G", "Ninja",
                f"-DCMAKE_PREFIX_PATH={self.prefix}")
            run(CMAKE, "--build", f"{work}/b")
            template = self.prefix / "share/ceres_dhcal/robots/ur5e.yaml"
            numbers = [float(word) for word in run(f"{work}/b/consumer", template).split()]
            for number, wanted in zip(numbers, [-817.2, -232.9, 62.8], strict=True):
                self.assertAlmostEqual(number, wanted, places=3)

    @unittest.skipUnless(shutil.which("help2man"), "help2man is not there: no man pages")
    def test_man_pages_say_what_help_says(self):
        for program in self.programs:
            page = (self.prefix / f"share/man/man1/{program}.1").read_text()
            self.assertIn(".SH NAME", page)
            self.assertRegex(page, rf"\n{program} \\- \w")
        page = (self.prefix / "share/man/man1/ceres_dhcal.1").read_text().replace("\\-", "-")
        for flag in ["--problem", "--accept", "--try_fix"]:
            self.assertIn(flag, page)

    def complete(self, *words):
        """What bash offers for the last of the words."""
        script = self.prefix / "share/bash-completion/completions/ceres_dhcal"
        line = " ".join(f"'{word}'" for word in words)
        program = self.prefix / "bin" / words[0]
        return run("bash", "-c", f"""
            source '{script}'
            COMP_WORDS=({line}); COMP_WORDS[0]='{program}'; COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
            _ceres_dhcal
            printf '%s\\n' "${{COMPREPLY[@]}}" """, cwd=self.prefix).split()

    def test_bash_completes_flags_robots_and_files(self):
        self.assertEqual(self.complete("ceres_dhcal", "--acc"), ["--accept"])
        self.assertEqual(self.complete("ceres_dhcal", "init", "ur5"), ["ur5", "ur5e"])
        self.assertEqual(self.complete("ceres_dhcal", "--diagnosis", "ne"), ["never"])
        self.assertEqual(self.complete("dhcal_compare", "sha"), ["share"])
        self.assertEqual(self.complete("ceres_dhcal", "ini"), ["init"])
        self.assertEqual(self.complete("dhcal_convert", "--base"), ["--base-link"])

    @unittest.skipUnless(shutil.which("dpkg-deb"), "dpkg-deb is not there")
    def test_a_debian_package_holds_the_program_and_names_what_it_needs(self):
        with tempfile.TemporaryDirectory() as work:
            run(pathlib.Path(CMAKE).with_name("cpack"), "-G", "DEB", "-B", work,
                "-D", "CPACK_COMPONENTS_ALL=runtime", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
                "--config", f"{BUILD}/CPackConfig.cmake")
            (package,) = pathlib.Path(work).glob("*.deb")
            self.assertEqual(run("dpkg-deb", "-f", package, "Package").strip(), "ceres-dhcal")
            if shutil.which("dpkg-shlibdeps"):
                self.assertIn("libmatio", run("dpkg-deb", "-f", package, "Depends"))
            run("dpkg-deb", "-x", package, f"{work}/root")
            listed = run(f"{work}/root/usr/bin/ceres_dhcal", "init", "--list")
            self.assertIn("ur5e", listed)
            self.assertNotIn("opencv", run("dpkg-deb", "-f", package, "Depends"))
            self.assertFalse(pathlib.Path(work, "root/usr/bin/dhcal_ruler").exists())


if __name__ == "__main__":
    CMAKE = sys.argv.pop(1)
    BUILD = sys.argv.pop(1)
    unittest.main()
