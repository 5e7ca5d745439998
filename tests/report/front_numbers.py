#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""front_numbers.py PAGE RESULTS: computes every number of the front page again, from the raw samples, counts and tables
of the result files. It shares no code with the report and does not use the places that the page names. Instead, the
sentences below define each number. A number on the page that is in none of these sentences is a fault; so is a sentence
that is missing on the page. Exit codes: 0 success, 1 faults."""

from __future__ import annotations

import functools
import html
import json
import math
import re
import statistics
import sys
from pathlib import Path
from typing import Any

FRACTALS = ("mandelbulb", "mandelbox")
NUMBER = r"\d[\d,]*(?:\.\d+)?"
MARGIN = 1.02  # times whose ratio is smaller count as the same
T_95 = dict(enumerate((12.7062, 4.30265, 3.18245, 2.77645, 2.57058, 2.44691, 2.36462, 2.30600, 2.26216), 1))


def text_of(page: str) -> str:
    """Returns the text of the front page, without its diagrams."""
    page = re.sub(r"<figure.*?</figure>", " ", page, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"</(p|h3|td|th|caption)>", " ", page))))


def two_sided(t: float, freedom: int) -> float:
    """Returns the two-sided p-value of Student's t, from Abramowitz and Stegun's finite sums, 26.7.3 and 26.7.4."""
    angle = math.atan(t / math.sqrt(freedom))
    term, total = (1.0, 1.0) if freedom % 2 == 0 else (math.cos(angle), math.cos(angle))
    for k in range(2 if freedom % 2 == 0 else 3, freedom, 2):
        term *= (k - 1) / k * math.cos(angle) ** 2
        total += term
    if freedom % 2 == 0:
        return 1 - math.sin(angle) * total
    return 1 - 2 / math.pi * (angle + (math.sin(angle) * total if freedom > 1 else 0))


class Times:
    """A value and its 95 % interval. The interval is computed with Student's t from the logarithms of `runs`, the
    values of single runs. If it does not contain the value, it is widened to contain it."""

    def __init__(self, value: float, runs: list[float]):
        logs = [math.log(one) for one in runs]
        half = T_95[len(logs) - 1] * statistics.stdev(logs) / math.sqrt(len(logs))
        mean = statistics.mean(logs)
        self.value = value
        beyond = mean - math.log(MARGIN)
        # The p-value for the hypothesis that the true ratio is MARGIN.
        self.p = 1 if beyond <= 0 else two_sided(T_95[len(logs) - 1] * beyond / half, len(logs) - 1)
        self.ends = (min(math.exp(mean - half), value), max(math.exp(mean + half), value))

    def numbers(self, scale: float = 1) -> list[float]:
        return [scale * number for number in (self.value, *self.ends)]


class File:
    """A result of bench: its rows by name."""

    def __init__(self, data: dict[str, Any]):
        self.data = data
        self.rows = {row["name"]: row for row in data["rows"]}

    def runs(self, name: str, clock: str) -> list[list[float]]:
        found: dict[int, list[float]] = {}
        for sample in self.rows[name]["samples"]:
            found.setdefault(sample["run"], []).append(sample[clock])
        return list(found.values())

    def kernel(self, name: str) -> Times:
        runs = self.runs(name, "kernel")
        return Times(statistics.median(sum(runs, [])), [statistics.median(one) for one in runs])

    def speed(self, name: str, base: str) -> Times:
        """Returns the speed-up, in wall time, of the row `name` over the row `base`."""
        own, other = self.runs(name, "wall"), self.runs(base, "wall")
        ratios = [statistics.median(b) / statistics.median(a) for a, b in zip(own, other)]
        return Times(statistics.median(sum(other, [])) / statistics.median(sum(own, [])), ratios)

    def ratio(self, above: str, below: str) -> Times:
        """Returns the kernel time of the row `above` divided by that of the row `below`, paired by round."""
        a, b = ({(s["run"], s["round"]): s["kernel"] for s in self.rows[name]["samples"]} for name in (above, below))
        runs: dict[int, list[float]] = {}
        for at in [at for at in a if at in b]:
            runs.setdefault(at[0], []).append(a[at] / b[at])
        return Times(statistics.median(sum(runs.values(), [])), [statistics.median(one) for one in runs.values()])

    def work(self, above: str, below: str, *keys: str) -> float:
        def of(name: str) -> float:
            values = [self.rows[name]["work"].get(key) or self.rows[name][key] for key in keys]
            return values[0] / (values[1] if len(values) > 1 else 1)

        return of(above) / of(below)


def name_of(fractal: str, precision: str, mode: str, backend: str = "openmp", value: str = "") -> str:
    return f"{fractal}/{precision}/{mode}/{backend}/0{value and '/' + value}"


def models(file: File) -> dict[str, list[tuple[float, Times, float]]]:
    """Returns, for each model that uses the scalar kernel, three values for each of its rows: the speed-up over openmp's
    scalar kernel with equal numbers of threads, the speed-up as measured, and the ratio of the two."""
    found: dict[str, list[tuple[float, Times, float]]] = {}
    for model in ("stdpar", "omptarget", "kokkos", "openacc"):
        for row in file.rows.values():
            if row["backend"] == model and row["samples"]:
                scalar = name_of(row["fractal"], row["precision"], row["mode"], "openmp", "simd-width=1")
                work = file.work(row["name"], scalar, "operations")
                if abs(work - 1) > 0.01:
                    # Loops for GPUs have no neighbours.
                    assert model in ("omptarget", "openacc") and row["mode"] == "fast", row["name"]
                    assert row["fractal"] == "mandelbulb" and 1 < work < 2, row["name"]
                    continue
                factor = file.rows[scalar]["threads"] / row["threads"]
                speed = file.speed(row["name"], scalar)
                found.setdefault(model, []).append((factor * speed.value, speed, factor))
    return found


def ends(speeds: list[tuple[float, Times, float]]) -> list[float]:
    return [n for pick in (min, max) for _, times, factor in [pick(speeds, key=lambda one: one[0])] for n in times.numbers(factor)]


def comparisons(file: File) -> dict[str, Times]:
    """Returns, by row, the kernel time of every backend but openmp and reference, divided by openmp's."""
    rows = [row for row in file.rows.values() if row["samples"] and row["backend"] not in ("openmp", "reference")]
    return {row["name"]: file.ratio(row["name"], name_of(row["fractal"], row["precision"], row["mode"])) for row in rows}


def decided(times: list[Times]) -> int:
    """Returns the number of values that are significantly above MARGIN, with Holm's correction."""
    p_values = sorted(one.p for one in times)
    return next((k for k, p in enumerate(p_values) if p > 0.05 / (len(p_values) - k)), len(p_values))


def standard_rows(folder: Path) -> list[dict[str, Any]]:
    """Returns the timed rows of all results of the standard study, without the reference's and the scalar kernel's."""
    files = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.json"))]
    studies = [f for f in files if isinstance(f, dict) and f.get("schema") == "mandelmarch-bench" and f["study"] == "standard"]
    return [r for f in studies for r in f["rows"] if r["samples"] and not r["sweep_value"] and r["backend"] != "reference"]


@functools.cache
def sentences(folder: Path) -> list[tuple[str, list[float]]]:
    """Returns the sentences that the page must contain for these results, and their numbers. `#` stands for a number,
    `~` for a number with its interval. The names of configurations in the sentences are computed from the results,
    too."""
    main = File(json.loads((folder / "bench.json").read_text(encoding="utf-8")))
    rows = standard_rows(folder)
    exact, fast = ([row for row in rows if row["mode"] == mode] for mode in ("exact", "fast"))
    same = [sum(row["verification"]["level"] == "same bits" for row in exact), len(exact)]
    cost = models(main)
    every = ends(sum(cost.values(), []))
    others = comparisons(main)
    count = [decided(list(others.values())), len(others)]
    side = [main.rows[name_of("mandelbulb", "double", "exact")]["setting"][key] for key in ("width", "height")]

    def case(name: str) -> tuple[str, list[float]]:
        fractal, precision, mode, backend = name.split("/")[:4]
        work = main.work(name, name_of(fractal, precision, mode), "operations")
        return f"~ times as long ({backend}; {fractal}, {precision}, {mode}), with # times the operations", [*others[name].numbers(), work]

    best: dict[str, str] = {}
    for name in others:
        kind = name.rpartition("/0")[0].rpartition("/")[0]
        best[kind] = min(best.get(kind, name), name, key=lambda n: others[n].value)
    nearest, farthest = (case(pick(best.values(), key=lambda n: others[n].value)) for pick in (min, max))

    def simd(mode: str) -> tuple[str, list[float]]:
        rows = [(name_of(f, "float", mode), name_of(f, "float", mode, "openmp", "simd-width=1")) for f in FRACTALS]
        speeds = [n for row, scalar in rows for n in main.speed(row, scalar).numbers()]
        work = [main.work(s, r, "operations") for r, s in rows]
        shown = any(f"{factor:.2f}" != "1.00" for factor in work)
        said = "factors of # and # come from fewer operations" if shown else "with as many operations"
        return f"in {mode} mode openmp is ~ and ~ times as fast as the scalar kernel on as many threads ({said})", speeds + work * shown

    serial = [main.speed(name_of(f, "float", "exact"), name_of(f, "double", "exact", "reference")) for f in FRACTALS]
    box, bulb = (name_of(f, "double", "exact") for f in FRACTALS[::-1])
    pairs = [[name_of(f, p, m) for f in FRACTALS[::-1]] for p, m in (("double", "exact"), ("float", "fast"))]
    factors = [main.work(box, bulb, *keys) for keys in (("de_calls",), ("iterations", "de_calls"), ("operations", "iterations"), ("operations",))]
    digits = [[main.ratio(name_of(f, "double", m), name_of(f, "float", m)) for f in FRACTALS] for m in ("exact", "fast")]
    return [
        ("it: # of # exact pictures have the same bits.", same),
        ("run at ~ to ~ times the speed of the same kernel", every),
        ("is faster in # of # comparisons with other backends", count),
        ("the slowest to the fastest of at most # cases of # x # pixels", [len(next(iter(cost.values()))), *side]),
        *((f"{model} ~ to ~", ends(speeds)) for model, speeds in cost.items()),
        ("For Mandelbulb and Mandelbox in float, # x # pixels", side),
        *(simd(mode) for mode in ("exact", "fast")),
        ("takes ~ and ~ times as long as openmp in exact mode", [n for one in serial for n in one.numbers()]),
        ("in exact mode: # of # exact pictures", same),
        ("at most # % of an official scene's pixels", [100 * max(r["verification"]["visibly_differing"] / r["verification"]["pixels"] for r in fast)]),
        ("In # of # comparisons the other backend takes significantly longer, at a level of # % for all", [*count, 5]),
        (f"The next best backend takes from {nearest[0]}, to {farthest[0]}.", nearest[1] + farthest[1]),
        *(box_or_bulb(*pair[0].split("/")[1:3], main.ratio(*pair)) for pair in pairs),
        ("All these pictures have # x # pixels", side),
        ("In double and exact mode, a pixel of the Mandelbox takes # times as many evaluations of the distance estimator (DE), an evaluation # "
         "times as many iterations, and an iteration # times as many operations: together # times as many operations.", factors),
        ("double takes ~ and ~ times as long in exact mode, and ~ and ~ times in fast mode", [n for two in digits for one in two for n in one.numbers()]),
        *(ladder(File(json.loads(path.read_text()))) for path in folder.glob("ladder.json")),
        *other_files(folder),
        ("In brackets: individual # % intervals of # runs", [95, main.data["runs"]]),
    ]


def ladder(file: File) -> tuple[str, list[float]]:
    """Returns the first table, the ladder, as a sentence with its numbers: for each rung and fractal the time and the
    gain over the rung before, and the gain of all rungs together. faults() has replaced names by asterisks."""
    rungs = [[name for name, row in file.rows.items() if row["fractal"] == fractal] for fractal in FRACTALS]

    def gain(name: str, before: str) -> list[float]:
        ratio = file.ratio(name, before)
        return [1 / value for value in (ratio.value, *ratio.ends[::-1])]

    setting = file.rows[rungs[0][0]]["setting"]
    values = [1.0, setting["width"], setting["height"], *(1e3 * file.kernel(names[0]).value for names in rungs)]
    for at in range(1, len(rungs[0])):
        for names in rungs:
            values += [1e3 * file.kernel(names[at]).value, *gain(names[at], names[at - 1])]
    return (
        f"Table #. Kernel time of # x # pixels, and gain over the rung before ({'*' * len(machine(file.data))}, ladder.json). "
        f"rung {FRACTALS[0]}, ms gain interval {FRACTALS[1]}, ms gain interval serial reference # # kernel as scalar C++ # ~ # ~ float for "
        "double # ~ # ~ explicit SIMD # ~ # ~ cheaper operations # ~ # ~ fewer DE evaluations # ~ # ~ all threads # ~ # ~ all together ~ ~",
        [*values, *(value for names in rungs for value in gain(names[-1], names[0]))],
    )


def other_files(folder: Path) -> list[tuple[str, list[float]]]:
    """Returns the sentences on random scenes, the GPU and the film."""
    wide = File(json.loads((folder / "resolution_fast.json").read_text(encoding="utf-8")))
    sums = {(s["fractal"], s["precision"]): s["all"]["off_percent"] for s in json.loads((folder / "random.json").read_text())["sums"]}
    film_size = [wide.rows[at("mandelbulb")]["setting"][key] for key in ("width", "height")]
    film = json.loads((folder / "film.json").read_text())
    return [
        ("# and # % of the pixels differ visibly from the canonical picture in float, and # and # % in double", [sums[f, p] for p in ("float", "double") for f in ("bulb", "box")]),
        gpu_sentence(folder, film_size, {f: wide.kernel(at(f)).numbers(1e3) for f in FRACTALS}),
        ("# minutes for # frames of # x # pixels (float, fast, # x # samples per pixel): # s in all, # s per frame",
         [film["seconds"] / 60, film["frames_rendered"], film["width"], film["height"], film["samples"], film["samples"], film["seconds"], film["seconds"] / film["frames_rendered"]]),
        ("together, on # threads of", [film["threads"]]),
    ]


def gpu_sentence(folder: Path, size: list[float], host: dict[str, list[float]]) -> tuple[str, list[float]]:
    """Returns the sentence on GPUs, of the fastest measured rows.
    `host`: by fractal, the milliseconds of the host and their interval. faults() has replaced names by asterisks."""
    found: dict[str, list[tuple[float, str]]] = {f: [] for f in FRACTALS}
    for row in standard_rows(folder):
        shown = [row["setting"][key] for key in ("width", "height")]
        if row["is_gpu"] and (row["precision"], row["mode"], shown) == ("float", "fast", size):
            ms = 1e3 * statistics.median(sample["kernel"] for sample in row["samples"])
            found[row["fractal"]].append((ms, f"on {'*' * len(row['device_name'])} with {row['backend']}"))
    best = {f: min(rows) for f, rows in found.items()}
    said = [f"# ms for the {f.capitalize()} {best[f][1]} (openmp on the processor: ~ ms, # times as long)" for f in FRACTALS]
    numbers = [n for f in FRACTALS for n in (best[f][0], *host[f], host[f][0] / best[f][0])]
    return f"in float and fast mode with # x # pixels: {' and '.join(said)}", size + numbers


def box_or_bulb(precision: str, mode: str, times: Times) -> tuple[str, list[float]]:
    low, high = times.ends
    same = 1 / MARGIN <= low and high <= MARGIN
    said = "the same within # %" if same else "it is slower" if low > 1 else "it is faster" if high < 1 else "undecided"
    return f"In {precision} and {mode} mode the Mandelbox takes ~ times as long: {said}.", times.numbers() + [2.0] * same


def at(fractal: str) -> str:
    return name_of(fractal, "float", "fast", "openmp", "size=1920x1080")


def is_written(text: str, value: float) -> bool:
    """Returns true if `value` rounds to the printed digits."""
    return abs(float(text.replace(",", "")) - value) <= 0.5001 * 10.0 ** -len(text.partition(".")[2])


def faults(page: str, folder: Path) -> list[str]:
    """Returns a line for each sentence that is missing on the page, each wrong number, and each number in no
    sentence."""
    text, found = text_of(page), []
    for name in names(folder):
        text = text.replace(name, "*" * len(name))
    covered = list(text)
    for sentence, values in sentences(folder):
        pattern = re.escape(sentence.replace("~", "# [#, #]")).replace(r"\#", f"({NUMBER})")
        matches = list(re.finditer(pattern, text))
        if not matches:
            found.append(f"the page does not say: {sentence}")
        for match in matches:
            wrong = [(said, value) for said, value in zip(match.groups(), values, strict=True) if not is_written(said, value)]
            found += [f"{sentence}: the page says {said}, the results {value}" for said, value in wrong]
            covered[match.start() : match.end()] = "*" * (match.end() - match.start())
    rest = "".join(covered)
    return found + [f"no sentence covers {m[0]}: ...{text[max(0, m.start() - 40) : m.end() + 20]}..." for m in re.finditer(NUMBER, rest)]


def machine(data: dict[str, Any]) -> str:
    cpu = data["environment"]["cpu"]
    return f"{cpu.get('platform', cpu['model'])}, {cpu['cores_usable']} threads"


@functools.cache
def names(folder: Path) -> list[str]:
    """Returns the names on the page that contain digits: names of machines, files and devices."""
    files = (folder / "bench.json", folder / "xeon" / "targets.json", folder / "ladder.json")
    machines = [machine(json.loads(path.read_text(encoding="utf-8"))) for path in files]
    gpus = {row["device_name"] for row in standard_rows(folder) if row.get("is_gpu")}
    return [*machines, *gpus, "bench.json"]


if __name__ == "__main__":
    wrong = faults(Path(sys.argv[1]).read_text(encoding="utf-8"), Path(sys.argv[2]))
    print(*wrong, sep="\n", end="\n" if wrong else "")
    sys.exit(1 if wrong else 0)
