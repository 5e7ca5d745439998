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
from pathlib import Path

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.path.insert(0, os.path.join(ROOT, "report"))
from mandelreport.errors import InputError, one_line, read_json, reading


class Entry:
    """A line of tools/results.txt. `minutes`: the estimated time of all runs of its command."""

    def __init__(self, line, number):
        words = shlex.split(line)
        try:
            self.name, self.minutes, runs = words[0], float(words[1]) * int(words[2]), words[2]
            self.variables = dict(word.split("=", 1) for word in words[3:] if word.split("=")[0].isupper())
            self.answers = [int(code) for code in self.variables.pop("EXITS", "0").split(",")]
            self.command = [word.replace("{runs}", runs) for word in words[3:] if not word.split("=")[0].isupper()]
            if not self.command:
                raise ValueError("no command")
        except (IndexError, ValueError) as error:
            sys.exit(fail(f"results.txt:{number}: {error}, expected a file, minutes, runs and a command", 2))

    def measure(self, programs, target):
        """Runs the command, which writes the file `target` completely or not at all. Returns 0 for success, otherwise
        the command's exit code, or another code if the result is missing or was measured with uncommitted sources."""
        program = os.path.join(ROOT if "/" in self.command[0] else programs, self.command[0])
        with tempfile.TemporaryDirectory(dir=os.path.dirname(target)) as scratch:
            part = os.path.join(scratch, os.path.basename(target))
            command = [program, *(part if word == "{}" else word.replace("{folder}", os.path.dirname(target))
                                  for word in self.command[1:])]
            with open(part if "{}" not in self.command else os.devnull, "w", encoding="utf-8") as output:
                code = code_of(command, output, self.variables)
            code = 0 if code in self.answers else code
            if code == 0 and not os.path.exists(part):
                code = 1
            elif code == 0 and of_uncommitted_sources(part):
                code = fail(f"{self.name}: a program of uncommitted sources wrote it: make build")
            if code == 0:
                os.replace(part, target)
            return code


STOPS = {signal.SIGINT, signal.SIGTERM}


def code_of(command, output, variables):
    """Runs a command and returns its exit code. If this program is stopped, also stops the command and all processes
    that the command started."""
    # Blocks signals until `process` is set, because the handler needs it to stop the command.
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)
    with subprocess.Popen(command, stdout=output, env=os.environ | variables, start_new_session=True,
                          preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)) as process:
        try:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)
            return process.wait()
        except KeyboardInterrupt:
            os.killpg(process.pid, signal.SIGTERM)
            raise


def of_uncommitted_sources(path):
    """Returns true if a result of bench records uncommitted sources."""
    if not path.endswith(".json"):
        return False
    data = read_json(Path(path), "a result in JSON")
    with reading(path, "a result of bench"):
        sides = (data, data.get("old", {}), data.get("new", {}))  # a duel has two programs
        return any(side.get("environment", {}).get("git", {}).get("dirty", False) for side in sides)


def fail(message, code=1):
    print(f"results: {message}", file=sys.stderr)
    return code


def git(sources, *arguments):
    run = subprocess.run(["git", "-C", sources, *arguments], capture_output=True, text=True, check=False)
    return run.stdout.strip() if run.returncode == 0 else None


def clean_revision(sources, program):
    """Returns the revision of the sources if they are committed and `program` was built from them. Otherwise prints a
    line and returns None."""
    revision = git(sources, "rev-parse", "HEAD")
    if not revision or git(sources, "status", "--porcelain", "--untracked-files=no", "--", ".", ":(exclude)results"):
        fail("the sources differ from the revision: commit first, as one result after the other must be of the same sources")
        return None
    try:
        built = subprocess.run([program, "--version"], capture_output=True, text=True, check=False).stdout
    except OSError as error:
        fail(f"{program}: {error.strerror}; make build")
        return None
    if f"({revision})" not in built:
        fail(f"{program} is '{built.strip()}', expected one built from {revision[:12]}: make build")
        return None
    return revision


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", default=os.path.join(HERE, "results.txt"))
    parser.add_argument("--programs", default=os.path.join(ROOT, "bin"))
    parser.add_argument("--work", default=os.path.join(ROOT, "build", "results"))
    parser.add_argument("--output", default=os.path.join(ROOT, "results"))
    parser.add_argument("--sources", default=ROOT, help="the repository (default: this one)")
    parser.add_argument("file", nargs="*")
    arguments = parser.parse_args()
    try:
        with open(arguments.list, encoding="utf-8") as file:
            lines = [(n, line) for n, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
    except OSError as error:
        return fail(f"{arguments.list}: {error.strerror}", 2)
    entries = [Entry(line, n) for n, line in lines]
    unknown = set(arguments.file) - {entry.name for entry in entries}
    if unknown:
        return fail(f"{', '.join(sorted(unknown))}: not in {arguments.list}", 2)
    if not os.path.isdir(arguments.output):
        return fail(f"{arguments.output}: not a folder, expected one for the results", 2)
    entries = [entry for entry in entries if not arguments.file or entry.name in arguments.file]
    revision = clean_revision(arguments.sources, os.path.join(arguments.programs, "bench"))
    if revision is None:
        return 2
    folder = os.path.join(arguments.work, revision)
    os.makedirs(folder, exist_ok=True)
    left = [entry for entry in entries if not os.path.exists(os.path.join(folder, entry.name))]
    fail(f"{len(entries)} files at {revision[:12]}, {len(entries) - len(left)} of them are there; the others take about "
         f"{sum(entry.minutes for entry in left):.0f} minutes. It can be stopped and goes on where it stopped.")
    for number, entry in enumerate(left):
        begin = time.monotonic()
        code = entry.measure(arguments.programs, os.path.join(folder, entry.name))
        if code != 0:
            return fail(f"{entry.name}: {' '.join(entry.command)}: exit code {code}; what was measured before stays in {folder}")
        fail(f"{entry.name} took {(time.monotonic() - begin) / 60:.1f} minutes; about "
             f"{sum(other.minutes for other in left[number + 1:]):.0f} are left")
    with tempfile.TemporaryDirectory(dir=arguments.output) as scratch:
        for entry in entries:
            shutil.copy(os.path.join(folder, entry.name), scratch)
        for entry in entries:
            os.replace(os.path.join(scratch, entry.name), os.path.realpath(os.path.join(arguments.output, entry.name)))
    return fail(f"{len(entries)} files in {arguments.output}: make results-page report", 0)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(fail("stopped; the same command goes on", 130))
    except (InputError, OSError) as failure:
        sys.exit(fail(one_line(failure)))
