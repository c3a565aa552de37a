#!/usr/bin/env python3
"""Runs clang-tidy over the .cc files of core, residuals, problems and tools, as far as needed.

usage: tools/tidy.py [--build DIR] [--jobs N] [--no-cache] [FILE...]

DIR (default build/release) must be configured: its compile_commands.json says how to read a file.
A file that passed is not read again until it, a project header that it includes, its compile
command, .clang-tidy or a package changes: its fingerprint is kept in ~/.cache/ceres_dhcal/tidy
(or $XDG_CACHE_HOME/ceres_dhcal/tidy), which all clones share.
Exit status: 0 = no finding, 1 = findings, 2 = cannot run.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ["core", "residuals", "problems", "tools"]
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def output_of(command):
    """Returns what a command prints, or nothing where there is no such command."""
    try:
        return subprocess.run(command, capture_output=True, check=False).stdout
    except FileNotFoundError:
        return b""


def environment_fingerprint(tidy):
    """Returns bytes that change with the rules, clang-tidy and the installed packages."""
    packages = (ROOT / "tools" / "packages.txt").read_text(encoding="utf-8")
    names = [line.split("#")[0].strip() for line in packages.splitlines()]
    return b"\n".join([
        (ROOT / ".clang-tidy").read_bytes(),
        output_of([tidy, "--version"]),
        output_of(["dpkg-query", "-W"] + [name for name in names if name]),
    ])


def project_files_of(source):
    """Returns a source and the project headers it includes, directly or not, in order."""
    found, open_files = set(), [source]
    while open_files:
        path = open_files.pop()
        if path in found:
            continue
        found.add(path)
        for name in INCLUDE.findall(path.read_bytes()):
            header = ROOT / name.decode()
            if header.is_file():
                open_files.append(header)
    return sorted(found)


def fingerprint(source, command, environment):
    """Returns the hash of all that decides what clang-tidy says about a source."""
    digest = hashlib.sha256(environment)
    digest.update(command.replace(str(ROOT), ".").encode())
    for path in project_files_of(source):
        digest.update(f"\n{path.relative_to(ROOT)}\n".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def check(tidy, build, source):
    """Returns (passed, findings) of one source."""
    command = [tidy, "-p", str(build), "--quiet", "--extra-arg=-Wno-unknown-warning-option"]
    done = subprocess.run(command + [str(source)], capture_output=True, text=True, check=False)
    # The count of suppressed warnings in system headers is no finding.
    noise = re.compile(r"^\d+ warnings?( and \d+ errors?)? generated\.$|^\d+ warnings? treated as ")
    errors = [line for line in done.stderr.splitlines() if not noise.match(line)]
    return done.returncode == 0, (done.stdout + "\n".join(errors)).strip()


def cache_folder():
    base = os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache"
    folder = pathlib.Path(base) / "ceres_dhcal" / "tidy"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def compile_commands(build, wanted):
    """Returns {source: command} for the layers' sources, or those of them that are wanted."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    folders = tuple(f"{ROOT / layer}{os.sep}" for layer in LAYERS)
    return {
        pathlib.Path(entry["file"]): entry["command"]
        for entry in entries
        if entry["file"].startswith(folders)
        and (not wanted or pathlib.Path(entry["file"]) in wanted)
    }


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--no-cache", action="store_true")
    parser.add_argument("files", nargs="*", type=lambda name: pathlib.Path(name).resolve())
    return parser.parse_args(arguments)


def run(arguments, tidy, commands):
    """Checks what is not known to pass; returns (number checked, number that failed)."""
    cache = cache_folder()
    environment = environment_fingerprint(tidy)
    stamps = {
        source: cache / fingerprint(source, command, environment)
        for source, command in commands.items()
    }
    stale = sorted(s for s in stamps if arguments.no_cache or not stamps[s].exists())
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = {pool.submit(check, tidy, arguments.build, source): source for source in stale}
        for result in concurrent.futures.as_completed(results):
            passed, findings = result.result()
            if passed:
                stamps[results[result]].touch()
            else:
                failed += 1
                print(findings, flush=True)
    return len(stale), failed


def main(arguments):
    arguments = parse_arguments(arguments)
    tidy = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
    if not tidy:
        print("tidy: clang-tidy is not installed; run tools/setup.sh.", file=sys.stderr)
        return 2
    if not (arguments.build / "compile_commands.json").is_file():
        print(f"tidy: {arguments.build} is not configured; run: cmake --preset release",
              file=sys.stderr)
        return 2
    commands = compile_commands(arguments.build, arguments.files)
    checked, failed = run(arguments, tidy, commands)
    print(f"tidy: {len(commands)} files: {checked} checked, {failed} with findings; "
          f"{len(commands) - checked} unchanged since they passed.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
