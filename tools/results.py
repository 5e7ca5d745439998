#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""results.py [FILE...]: measures all committed results again, or the given ones, from one clean revision.

tools/results.txt lists the results. Prints the expected time. Can be stopped at any time: finished results stay in
WORK/REVISION, and the same command resumes. Copies the results to --output when all are finished, so that without FILE
it never holds results of two revisions.
Exit codes: 0 complete, 1 a command failed, 2 programs or sources are not from one clean revision, 130 stopped."""
import argparse
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "report"))
from mandelreport.errors import InputError, read_json, reading, run_program

STOPS = {signal.SIGINT, signal.SIGTERM}


@dataclass
class Entry:
    """A line of tools/results.txt. `minutes`: the estimated time of all runs; `exits`: exit codes of success."""
    name: str
    minutes: float
    variables: dict
    exits: list
    command: list


def entry_of(line):
    name, minutes, runs, *words = shlex.split(line)
    variables = dict(word.split("=", 1) for word in words if word.split("=")[0].isupper())
    exits = [int(code) for code in variables.pop("EXITS", "0").split(",")]
    program, *arguments = (word.replace("{runs}", runs) for word in words if not word.split("=")[0].isupper())
    return Entry(name, float(minutes) * int(runs), variables, exits, [program, *arguments])


def entries_of(path):
    entries = []
    with reading(path, "a list of results"):
        lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        if line.strip() and line[0] != "#":
            with reading(f"{path}:{number}", "a file, minutes, runs and a command"):
                entries.append(entry_of(line))
    return entries


def run(entry, command):
    """Runs a command. If this program is stopped, also stops the command and all processes that it started."""
    # Blocks signals until `process` is set, because it is needed to stop the command.
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, env=os.environ | entry.variables, start_new_session=True,
                          preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)) as process:
        try:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)
            code = process.wait()
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGTERM)
            raise
    if code not in entry.exits:
        sys.exit(f"results: {entry.name}: {' '.join(entry.command)}: exit code {code}; the finished results are kept")


def measure(entry, programs, target):
    """Writes the file `target` completely or not at all."""
    with tempfile.TemporaryDirectory(dir=target.parent) as scratch:
        part = Path(scratch, target.name)
        program, *arguments = entry.command
        run(entry, [programs / program, *(part if word == "{}" else word for word in arguments)])
        with reading(entry.name, "a result of bench"):
            if read_json(part, "a result of bench")["environment"]["git"]["dirty"]:
                sys.exit(f"results: {entry.name}: a program of uncommitted sources wrote it: make build")
        os.replace(part, target)


def clean_revision(sources, program):
    """Returns the revision of the sources. Raises InputError unless they are committed and `program` was built from
    them."""
    def git(*arguments):
        return subprocess.run(["git", "-C", sources, *arguments], capture_output=True, text=True, check=False).stdout.strip()

    revision = git("rev-parse", "HEAD")
    if not revision or git("status", "--porcelain", "--untracked-files=no", "--", ".", ":(exclude)results"):
        raise InputError("the sources differ from the revision: commit first, as all results must be of the same sources")
    with reading(program, "a program: make build"):
        built = subprocess.run([program, "--version"], capture_output=True, text=True, check=False).stdout
    if f"({revision})" not in built:
        raise InputError(f"{program} is '{built.strip()}', expected one built from {revision[:12]}: make build")
    return revision


def report(text):
    print(f"results: {text}", file=sys.stderr)


def measure_all(arguments):
    entries = entries_of(arguments.list)
    if unknown := set(arguments.file) - {entry.name for entry in entries}:
        raise InputError(f"{', '.join(sorted(unknown))}: not in {arguments.list}")
    if not arguments.output.is_dir():
        raise InputError(f"{arguments.output}: not a folder, expected one for the results")
    entries = [entry for entry in entries if not arguments.file or entry.name in arguments.file]
    revision = clean_revision(arguments.sources, arguments.programs / "bench")
    folder = arguments.work / revision
    folder.mkdir(parents=True, exist_ok=True)
    left = [entry for entry in entries if not (folder / entry.name).exists()]
    report(f"{len(entries)} files at {revision[:12]}, {len(entries) - len(left)} of them are finished; the others take about "
           f"{sum(entry.minutes for entry in left):.0f} minutes. If it is stopped, the same command resumes.")
    for number, entry in enumerate(left, 1):
        begin = time.monotonic()
        measure(entry, arguments.programs, folder / entry.name)
        report(f"{entry.name} took {(time.monotonic() - begin) / 60:.1f} minutes; about "
               f"{sum(other.minutes for other in left[number:]):.0f} are left")
    with tempfile.TemporaryDirectory(dir=arguments.output) as scratch:
        for entry in entries:
            shutil.copy(folder / entry.name, scratch)
        for entry in entries:
            os.replace(Path(scratch, entry.name), (arguments.output / entry.name).resolve())
    report(f"{len(entries)} files in {arguments.output}: make results-page report")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in {"list": ROOT / "tools" / "results.txt", "programs": ROOT / "bin", "work": ROOT / "build" / "results",
                          "output": ROOT / "results", "sources": ROOT}.items():
        parser.add_argument(f"--{name}", type=Path, default=default)
    parser.add_argument("file", nargs="*")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        measure_all(arguments)
    except KeyboardInterrupt:
        report("stopped; the same command resumes")
        return 130
    return 0


if __name__ == "__main__":
    run_program("results", main)
