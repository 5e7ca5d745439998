#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_results.py RESULTS.tgz INTO: unpacks the results of packaging/gpu_check into INTO/DEVICE and writes a summary
page, README.md: backends with the same bits, measured and expected times, and the last output lines of failed steps."""
import argparse
import glob
import json
import os
import re
import shutil
import statistics
import sys
import tarfile
import tempfile

STEP = re.compile(r"^(\S+) +(passed|skipped|failed|late) +(\d+) s  ?(.*)$")
BACKENDS = ("cuda", "hip", "openacc", "omptarget", "opencl", "vulkan")
EXPECTED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "report", "results")


def fail(text):
    sys.exit(f"gpu_results: {text}")


def text_of(*path):
    try:
        with open(os.path.join(*path), encoding="utf-8", errors="replace") as file:
            return file.read()
    except FileNotFoundError:
        return ""


def unpack(archive, into):
    """Unpacks the archive below `into`. Returns the folder of the results."""
    try:
        with tarfile.open(archive) as tar:
            tar.extractall(into, filter="data")
    except (OSError, EOFError, tarfile.TarError) as error:
        fail(f"{archive}: {str(error).partition(chr(10))[0]}, expected the results.tgz of gpu_check")
    folder = os.path.join(into, "results")
    if not os.path.exists(os.path.join(folder, "summary.txt")):
        fail(f"{archive}: lacks results/summary.txt, expected the results.tgz of gpu_check")
    return folder


def steps_of(folder):
    """Returns, by step, its result, its seconds and its last output line."""
    return {found[1]: (found[2], int(found[3]), found[4]) for found in map(STEP.match, text_of(folder, "summary.txt").splitlines())
            if found}


def expected_times(device):
    """Returns, by backend, fractal, precision and mode, the range of the kernel time in milliseconds that is expected
    on the GPU whose name is in `device`. An H200 has the H100's multiprocessors."""
    for gpu, names in {"k40": ("K40",), "h100": ("H100", "H200")}.items():
        if any(name in device for name in names):
            lines = map(str.split, text_of(EXPECTED, f"{gpu}_expected.txt").splitlines())
            return {(words[3], *words[:3]): (float(words[-2]), float(words[-1])) for words in lines if len(words) == 12 and words[3] in BACKENDS}
    return {}


def rows_of(folder):
    """Yields the timed and verified configurations in bench's results of the steps t-*."""
    for path in sorted(glob.glob(os.path.join(folder, "t-*.json"))):
        try:
            rows = json.loads(text_of(path))["rows"]
        except (ValueError, KeyError):
            continue
        yield from (row for row in rows if row["samples"] and row["verification"]["passed"])


def times(folder, device):
    """Returns words for the number of pictures and their size, empty if there are none, and a table: the kernel
    milliseconds of each backend, for each fractal, precision and mode."""
    expected = expected_times(device)
    sizes, counts, cells = set(), set(), {}
    for row in rows_of(folder):
        kind = row["fractal"], row["precision"], row["mode"]
        milliseconds = 1000 * statistics.median(sample["kernel"] for sample in row["samples"])
        low, high = expected.get((row["backend"], *kind), (None, None))
        beside = "" if low is None else f" ({low:.3g} to {high:.3g})"
        cells.setdefault(kind, {})[row["backend"]] = f"{milliseconds:.4g}{beside}"
        counts.add(len(row["samples"]))
        sizes.add(f"{row['setting']['width']} x {row['setting']['height']}")
    timed = [name for name in BACKENDS if any(name in row for row in cells.values())]
    table = [f"| picture | {' | '.join(timed)} |", "|---" * (len(timed) + 1) + "|"]
    table += [f"| {' '.join(kind)} | {' | '.join(row.get(name, '-') for name in timed)} |" for kind, row in sorted(cells.items())]
    return f"{min(counts)} to {max(counts)} pictures of {', '.join(sorted(sizes))}" if cells else "", table


def page(folder, device, steps):
    summary = [f"# {device}", ""]
    if text_of(folder, "rehearsal"):
        summary += ["**A rehearsal: these results are not from a GPU.**", ""]
    driver = re.search(r"Driver Version\s*:\s*(\S+)", text_of(folder, "nvidia-smi.txt"))
    programs = re.search(r"^render .*$", text_of(folder, "facts.log"), re.M)
    passed = sum(result == "passed" for result, _, _ in steps.values())
    summary.append(f"{passed} of {len(steps)} steps passed in {sum(seconds for _, seconds, _ in steps.values())} s; driver "
                   f"{driver[1] if driver else 'unknown'}; {programs[0] if programs else 'unknown programs'}.")
    tried = [name for name in BACKENDS if name in steps]
    same = [name for name in tried if steps[name][0] == "passed"]
    summary += ["", f"- Same bits as the host: {', '.join(same) or 'no backend'}."]
    summary += [f"- {name}: {steps[name][2] or steps[name][0]}." for name in tried if name not in same]
    pictures, table = times(folder, device)
    if pictures:
        summary += ["", f"Median kernel times in ms of {pictures}, in a single run, with the expected range in brackets",
                    "([why many are longer](../../../docs/gpu-predictions.md#beside-measured-times)):", "", *table]
    broken = [(name, *step) for name, step in steps.items() if step[0] in ("failed", "late") and name not in BACKENDS]
    if broken:
        summary += ["", *(f"- Step {name} {result}: {words or 'no output'}" for name, result, _, words in broken)]
    summary += ["", "## Steps", "", "| step | result | seconds | last output line |", "|---|---|---|---|"]
    summary += [f"| {name} | {result} | {seconds} | {words.replace('|', '/')} |" for name, (result, seconds, words) in steps.items()]
    return "\n".join(summary) + "\n"


def device_of(folder):
    """Returns the GPU's name as nvidia-smi reports it or, if that is missing, as a backend reports it."""
    if found := re.search(r"Product Name\s*:\s*(.+)", text_of(folder, "nvidia-smi.txt")):
        return found[1].strip()
    for path in sorted(glob.glob(os.path.join(folder, "seen-*.json"))):
        return json.loads(text_of(path))["device"]["name"]
    return "no GPU"


def free_folder(into, name):
    """Returns a path that does not exist yet: INTO/NAME or, if that exists, INTO/NAME with a number appended."""
    for number in range(1, 1000):
        path = os.path.join(into, name if number == 1 else f"{name}-{number}")
        if not os.path.exists(path):
            return path
    fail(f"{into}: already has 999 results of {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results")
    parser.add_argument("into")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.into):
        fail(f"{arguments.into}: no such folder")
    # Unpacks into a temporary folder and renames it, so that the new folder appears complete or not at all.
    with tempfile.TemporaryDirectory(dir=arguments.into, prefix=".gpu-results-") as temporary:
        folder = unpack(arguments.results, temporary)
        steps = steps_of(folder)
        device = device_of(folder)
        with open(os.path.join(folder, "README.md"), "w", encoding="utf-8") as file:
            file.write(page(folder, device, steps))
        # The stats of the exact pictures are in the summary. Pictures with other bits are kept.
        for path in [*glob.glob(os.path.join(folder, "bits-*", "*.json")), *glob.glob(os.path.join(folder, "seen-*"))]:
            os.remove(path)
        for path in glob.glob(os.path.join(folder, "bits-*")):
            if not os.listdir(path):
                os.rmdir(path)
        name = ("rehearsal-" if text_of(folder, "rehearsal") else "") + re.sub(r"[^A-Za-z0-9]+", "-", device).strip("-")
        target = free_folder(arguments.into, name)
        shutil.move(folder, target)
    with open(os.path.join(target, "README.md"), encoding="utf-8") as file:
        print(file.read().split("\n## Steps")[0])
    print(os.path.join(target, "README.md"))


if __name__ == "__main__":
    main()
