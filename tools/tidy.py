#!/usr/bin/env python3
"""Runs clang-tidy over the .cc files of core, residuals, problems and tools, as far as needed.

usage: tools/tidy.py [--build DIR] [--jobs N] [--batch N] [--no-cache] [--no-analyzer] [FILE...]

DIR (default build/dev) must be configured, without unity builds: its compile_commands.json says how
to read a file.
Most of clang-tidy's time goes into headers and template instantiations. So the files of one target
are read N (default 16) at a time, one behind the other as a single source. That only finds out that
all is well: the files of a batch with any finding, also that two define the same name, are read
again one by one, and what is said then counts. --batch 1 reads all one by one.
--no-analyzer leaves out the checks that follow all paths through a function (clang-analyzer-*),
which take two fifths of the time. What they alone could find, the sanitizers' tests mostly do.
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
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ["core", "residuals", "problems", "tools"]
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
# What is no code; a name that using or namespace = introduces; a name that needs no such help.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', re.MULTILINE | re.DOTALL)
ALIAS = re.compile(r"^\s*(?:using [\w:]*::(\w+);|namespace (\w+) = )", re.MULTILINE)
OBJECT = re.compile(r" -o \S*?([^/\s]+)\.dir/")
QUALIFIED = r"(?:::|\.|->)\s*%s\b"


def output_of(command):
    """Returns what a command prints, or nothing where there is no such command."""
    try:
        return subprocess.run(command, capture_output=True, check=False).stdout
    except FileNotFoundError:
        return b""


def environment_fingerprint(tidy, options):
    """Returns bytes that change with the rules, clang-tidy and the installed packages."""
    names = output_of([ROOT / "tools" / "setup.sh", "--list"]).decode().split()
    return b"\n".join([
        (ROOT / ".clang-tidy").read_bytes(),
        output_of([tidy, "--version"]),
        output_of(["dpkg-query", "-W"] + names),
        *(option.encode() for option in options),
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


def check(tidy, build, source, options=()):
    """Returns (passed, findings) of one source."""
    command = [tidy, "-p", str(build), "--quiet", "--extra-arg=-Wno-unknown-warning-option",
               *options]
    done = subprocess.run(command + [str(source)], capture_output=True, text=True, check=False)
    # The count of suppressed warnings in system headers is no finding.
    noise = re.compile(r"^\d+ warnings?( and \d+ errors?)? generated\.$|^\d+ warnings? treated as ")
    errors = [line for line in done.stderr.splitlines() if not noise.match(line)]
    return done.returncode == 0, (done.stdout + "\n".join(errors)).strip()


def may_share(source):
    """Returns whether a source uses all its using-declarations: its neighbour may use them, too."""
    code = NO_CODE.sub(" ", source.read_text(encoding="utf-8"))
    for names in ALIAS.findall(code):
        name = re.escape(names[0] or names[1])
        uses = len(re.findall(rf"\b{name}\b", code)) - len(re.findall(QUALIFIED % name, code))
        if uses < (1 if names[0] else 2):
            return False
    return True


def batches_of(sources, commands, size):
    """Returns lists of sources of one CMake target, and so with the same options, to read together.

    The upper layers come first, since their batches take longest.
    """
    groups = {}
    for source in reversed(sources):
        target = OBJECT.search(commands[source]).group(1)
        key = target if size > 1 and may_share(source) else source
        groups.setdefault(key, []).append(source)
    return [group[first:first + size]
            for group in groups.values() for first in range(0, len(group), size)]


def check_batch(tidy, build, sources, command, options):
    """Returns {source: (passed, findings)} of a batch of sources."""
    if len(sources) > 1:
        with tempfile.TemporaryDirectory() as folder:
            # The sources' text, not #includes of them: some checks look at the main file only.
            together = pathlib.Path(folder) / sources[0].name
            together.write_text(
                "\n".join(f'#line 1 "{s}"\n{s.read_text(encoding="utf-8")}' for s in sources),
                encoding="utf-8")
            entry = {"directory": str(build), "file": str(together),
                     "command": command.replace(str(sources[0]), str(together))}
            (pathlib.Path(folder) / "compile_commands.json").write_text(json.dumps([entry]))
            config = [f"--config-file={ROOT / '.clang-tidy'}", *options]
            passed, findings = check(tidy, folder, together, config)
            if passed:
                return {source: (True, "") for source in sources}
            print(f"tidy: reads {len(sources)} files one by one, since together they have findings:"
                  f"\n{findings[:300]}", file=sys.stderr, flush=True)
    return {source: check(tidy, build, source, options) for source in sources}


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
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "dev")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--batch", type=int, default=16)
    parser.add_argument("--no-cache", action="store_true")
    parser.add_argument("--no-analyzer", action="store_true")
    parser.add_argument("files", nargs="*", type=lambda name: pathlib.Path(name).resolve())
    return parser.parse_args(arguments)


def run(arguments, tidy, commands):
    """Checks what is not known to pass; returns (number checked, number that failed)."""
    cache = cache_folder()
    options = ["--checks=-clang-analyzer-*"] if arguments.no_analyzer else []
    environment = environment_fingerprint(tidy, options)
    stamps = {
        source: cache / fingerprint(source, command, environment)
        for source, command in commands.items()
    }
    stale = sorted(s for s in stamps if arguments.no_cache or not stamps[s].exists())
    batches = batches_of(stale, commands, max(1, arguments.batch))
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        done = [pool.submit(
            check_batch, tidy, arguments.build, batch, commands[batch[0]], options)
                for batch in batches]
        for batch in concurrent.futures.as_completed(done):
            for source, (passed, findings) in batch.result().items():
                if passed:
                    stamps[source].touch()
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
        print(f"tidy: {arguments.build} is not configured; run: cmake --preset dev",
              file=sys.stderr)
        return 2
    commands = compile_commands(arguments.build, arguments.files)
    checked, failed = run(arguments, tidy, commands)
    print(f"tidy: {len(commands)} files: {checked} checked, {failed} with findings; "
          f"{len(commands) - checked} unchanged since they passed.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
