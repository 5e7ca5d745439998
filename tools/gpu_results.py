#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_results.py RESULTS.tgz INTO: unpacks the results of packaging/gpu_check into INTO/DEVICE and writes a summary
page, README.md: backends with the same bits, kernel times, and the last output lines of failed steps. bench's JSON
files are beside it; all other files are packed into logs.tar.xz."""
import argparse
import io
import itertools
import json
import math
import os
import re
import statistics
import sys
import tarfile
import tempfile
import zlib
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report"))
from mandelreport.errors import InputError, one_line, reading, run_program, write_whole

STEP = re.compile(r"^(\S+) +(passed|skipped|failed|late) +(\d{1,6}) s *(.*)$")
EXPECTED = "the results.tgz of gpu_check"
LONGEST_NAME = 60  # characters of a device's name, at most four bytes each


def files_of(archive):
    """Returns the contents of the files in the archive's folder of results, by their names in it."""
    try:
        with reading(archive, EXPECTED), tarfile.open(archive, "r:gz") as tar:
            members = [member for member in tar if member.isreg() and member.name.startswith("results/")]
            files = {member.name.removeprefix("results/"): tar.extractfile(member).read() for member in members}
            if "summary.txt" not in files:
                raise ValueError("results/summary.txt is missing")
    except (zlib.error, tarfile.TarError) as error:
        raise InputError(f"{archive}: {error}, expected {EXPECTED}") from error
    return files


def text_of(files, name):
    """Returns the lines of a file without escape codes, empty if there is no file."""
    return "\n".join(map(one_line, files.get(name, b"").decode("utf-8", "replace").splitlines()))


def steps_of(files):
    """Returns, by step, its result, its seconds and its last output line."""
    return {found[1]: (found[2], int(found[3]), found[4]) for found in map(STEP.match, text_of(files, "summary.txt").splitlines())
            if found}


def rows_of(files):
    """Yields the picture, the backend, the kernel milliseconds, the number of pictures and the size of each timed and
    verified configuration in bench's results of the steps t-*."""
    for name in sorted(name for name in files if re.fullmatch(r"t-[^/]*\.json", name)):
        with reading(name, EXPECTED):
            for row in json.loads(files[name])["rows"]:
                if not row["samples"] or not row["verification"]["passed"]:
                    continue
                milliseconds = 1000 * statistics.median(float(sample["kernel"]) for sample in row["samples"])
                if not math.isfinite(milliseconds):
                    raise ValueError("a time is not finite")
                kind = one_line(" ".join([row["fractal"], row["precision"], row["mode"]]))
                size = f"{int(row['setting']['width'])} x {int(row['setting']['height'])}"
                yield kind, str(row["backend"]), milliseconds, len(row["samples"]), size


def first_picture(files, backend):
    """Returns the milliseconds from opening the backend's device to the end of its first picture; "-" if unknown."""
    name = f"seen-{backend}.json"
    if name not in files:
        return "-"
    with reading(name, EXPECTED):
        seconds = json.loads(files[name])["seconds"]
        return f"{1000 * (seconds['context'] + seconds['wall']):.4g}"


def times(files):
    """Returns words for the number of pictures and their size, empty if there are none, and a table: the kernel
    milliseconds of each backend, for each fractal, precision and mode, and those of first_picture()."""
    sizes, counts, cells = set(), set(), {}
    for kind, backend, milliseconds, count, size in rows_of(files):
        cells.setdefault(kind, {})[backend] = f"{milliseconds:.4g}"
        counts.add(count)
        sizes.add(size)
    timed = list(dict.fromkeys(name for row in cells.values() for name in row))
    table = [f"| picture | {' | '.join(timed)} |", "|---" * (len(timed) + 1) + "|"]
    table += [f"| {kind} | {' | '.join(row.get(name, '-') for name in timed)} |" for kind, row in sorted(cells.items())]
    table.append(f"| first picture | {' | '.join(first_picture(files, name) for name in timed)} |")
    return f"{' or '.join(map(str, sorted(counts)))} pictures of {', '.join(sorted(sizes))}" if cells else "", table


def page(files, device, steps):
    summary = [f"# {device}", ""]
    if text_of(files, "rehearsal"):
        summary += ["**A rehearsal: these results are not from a GPU.**", ""]
    driver = re.search(r"Driver Version\s*:\s*(\S+)", text_of(files, "nvidia-smi.txt"))
    programs = re.search(r"^render .*$", text_of(files, "facts.log"), re.M)
    passed = sum(result == "passed" for result, _, _ in steps.values())
    summary.append(f"{passed} of {len(steps)} steps passed in {sum(seconds for _, seconds, _ in steps.values())} s; driver "
                   f"{driver[1] if driver else 'unknown'}; {programs[0] if programs else 'unknown programs'}.")
    tried = [name for name in text_of(files, "backends").split() if name in steps]
    same = [name for name in tried if steps[name][0] == "passed"]
    summary += ["", f"- Same bits as the host: {', '.join(same) or 'no backend'}."]
    summary += [f"- {name}: {steps[name][2] or steps[name][0]}." for name in tried if name not in same]
    pictures, table = times(files)
    if pictures:
        summary += ["", f"Median kernel times in ms of {pictures}. First picture: from opening the device to the end of a picture of",
                    "32 x 32 pixels, with all kernels to be translated by the driver:", "", *table]
    broken = [(name, *step) for name, step in steps.items() if step[0] in ("failed", "late") and name not in tried]
    if broken:
        summary += ["", *(f"- Step {name} {result}: {words or 'no output'}" for name, result, _, words in broken)]
    summary += ["", "## Steps", "", "| step | result | seconds | last output line |", "|---|---|---|---|"]
    summary += [f"| {name} | {result} | {seconds} | {words.replace('|', '/')} |" for name, (result, seconds, words) in steps.items()]
    return "\n".join(summary) + "\n"


def device_of(files):
    """Returns the GPU's name as nvidia-smi reports it or, if that is missing, as a backend reports it."""
    if found := re.search(r"Product Name *:(.*)", text_of(files, "nvidia-smi.txt")):
        if not found[1].strip():
            raise InputError("nvidia-smi.txt: an empty product name, expected the GPU's name")
        return found[1].strip()
    for name in sorted(name for name in files if re.fullmatch(r"seen-[^/]*\.json", name)):
        with reading(name, EXPECTED):
            return one_line(json.loads(files[name])["device"]["name"])
    return "no GPU"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results")
    parser.add_argument("into")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.into):
        raise InputError(f"{arguments.into}: no such folder")
    files = files_of(arguments.results)
    device = device_of(files)
    text = page(files, device, steps_of(files))
    of_bench = {name for name in files if re.fullmatch(r"(?!seen-)[^/]*\.json", name)}
    # Renames a temporary folder, so that the new folder appears complete or not at all.
    with tempfile.TemporaryDirectory(dir=arguments.into, prefix=".gpu-results-") as temporary:
        folder = Path(temporary, "results")
        write_whole(folder / "README.md", text.encode())
        for name in of_bench:
            write_whole(folder / name, files[name])
        with tarfile.open(folder / "logs.tar.xz", "w:xz") as tar:
            for name in sorted(files.keys() - of_bench):
                member = tarfile.TarInfo(name)
                member.size = len(files[name])
                tar.addfile(member, io.BytesIO(files[name]))
        name = re.sub(r"\W+", "-", device)[:LONGEST_NAME].strip("-") or "unnamed"
        first = Path(arguments.into, ("rehearsal-" if text_of(files, "rehearsal") else "") + name)
        others = (first.with_name(f"{first.name}-{number}") for number in itertools.count(2))
        target = next(path for path in itertools.chain([first], others) if not path.exists())
        os.rename(folder, target)
    print(text.split("\n## Steps")[0])
    print(target / "README.md")
    return 0


if __name__ == "__main__":
    run_program("gpu_results", main)
