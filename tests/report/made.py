# SPDX-License-Identifier: Apache-2.0
"""Synthetic result files, small and complete. They are parts of stored results, with other values."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import made_programs

from mandelreport.results import RESULTS, Files, Results, read_results

ROOT = Path(__file__).parents[2]
STORED = Files(ROOT / RESULTS, made_programs.TESTED)


def stored(name: str) -> Any:
    return STORED.json(name.removesuffix(".json"))


BENCH = stored("bench.json")
ROW = next(row for row in BENCH["rows"] if row["backend"] == "openmp")
COUNT = next(count for count in BENCH["counts"] if count["precision"] == "double")
OTHER = BENCH["winners"][0]["others"][0]
QUESTIONS = ("mandelbox_to_mandelbulb", "double_to_float", "others_to_host", "to_first_value", "to_previous_value")


def summary(median: float) -> dict[str, Any]:
    return {
        "count": 9,
        "runs": 1,
        "median": median,
        "mad": 0.01 * median,
        "min": 0.9 * median,
        "max": 1.1 * median,
        "interval": [0.95 * median, 1.05 * median],
    }


def row(
    fractal: str, precision: str, mode: str, backend: str, seconds: float, value: str = "", **setting: Any
) -> dict[str, Any]:
    return ROW | {
        "name": f"{fractal}/{precision}/{mode}/{backend}/0" + (f"/{value}" if value else ""),
        "fractal": fractal,
        "precision": precision,
        "mode": mode,
        "backend": backend,
        "application": f"{backend}-scalar" if value == "simd-width=1" else backend,
        "sweep_value": value,
        "setting": ROW["setting"] | setting,
        "platform": "Processor",
        "device_name": "Processor",
        "instruction_set": "",
        "simd_width": 16,
        "work": {"steps": 9, "de_calls": 9, "iterations": 9},
        "operations": 1e9,
        "samples": [ROW["samples"][0] | {"run": 0, "round": 0, "kernel": seconds, "wall": seconds}],
        "figures": ROW["figures"] | {
            "kernel_seconds": summary(seconds),
            "wall_seconds": summary(1.1 * seconds),
            "share_of_peak": 0.1,
            "speed_up": 1.5,
            "speed_up_interval": None,
            "over_scalar": 2.0,
            "over_scalar_interval": [1.9, 2.1],
        },
    }


def count(fractal: str, iterations: int) -> dict[str, Any]:
    work = {"steps": 5000, "de_calls": 6000, "iterations": iterations}
    return COUNT | {"fractal": fractal, "pixels": 1000, "hits": 300, "work": work}


def bench(study: str = "standard", rows: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    """Returns a complete result, with the given rows or, by default, with rows of two backends for each fractal,
    precision and mode."""
    made = (
        rows
        if rows is not None
        else [
            row(fractal, precision, mode, backend, 0.1 + 0.0123 * number + (0.05 if fractal == "mandelbox" else 0))
            for number, (fractal, precision, mode, backend) in enumerate(
                (f, p, m, b)
                for f in ("mandelbulb", "mandelbox")
                for p in ("double", "float")
                for m in ("exact", "fast")
                for b in ("openmp", "vulkan")
            )
        ]
    )
    ratio = {
        "numerator": "mandelbox/double/exact/openmp/0",
        "denominator": "mandelbulb/double/exact/openmp/0",
        "ratio": summary(1.5),
    }
    environment = copy.deepcopy(BENCH["environment"])
    environment |= {
        "date": "2026-01-02T03:04:05Z",
        "git": {"revision": "0123456789abcdef", "dirty": False},
        "backends": [backend for backend in environment["backends"] if backend["name"] == "openmp"],
    }
    environment["cpu"]["platform"] = environment["cpu"]["model"] = "Processor"
    application = next(entry for entry in BENCH["portability"] if entry["application"] == "openmp")
    return copy.deepcopy(
        BENCH
        | {
            "study": study,
            "runs": 1,
            "warnings": [],
            "environment": environment,
            "peaks": [BENCH["peaks"][0] | {"platform": "Processor", "operations_per_second": 1e10}],
            "counts": [count("mandelbulb", 12000), count("mandelbox", 36000)],
            "rows": made,
            "questions": {question: [ratio] if question == "mandelbox_to_mandelbulb" else [] for question in QUESTIONS},
            "portability": [application],
            "winners": winners(made) if study == "standard" else [],
        }
    )


def winners(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for one in sorted((row for row in rows if row["figures"]), key=lambda row: row["figures"]["kernel_seconds"]["median"]):
        found.setdefault("/".join(one["name"].split("/")[:3]), []).append(one)
    return [{"fastest": first["name"], "others": [OTHER | {"name": one["name"]} for one in others]} for first, *others in found.values()]


def with_scalar() -> dict[str, Any]:
    """Returns a result that includes the scalar kernel's rows."""
    data = bench()
    kinds = [(row["fractal"], row["precision"], row["mode"]) for row in data["rows"] if row["backend"] == "openmp"]
    data["rows"] += [row(*kind, "openmp", 1.23, "simd-width=1", simd_width=1) for kind in kinds]
    for scalar in data["rows"][-len(kinds) :]:
        scalar["figures"] |= {"over_scalar": None, "over_scalar_interval": None}
    return data


def sweep(study: str, name: str, values: list[str]) -> dict[str, Any]:
    rows = [row("mandelbulb", "float", "exact", "openmp", 0.1 / (k + 1), f"{name}={value}") for k, value in enumerate(values)]
    data = bench(study, rows)
    data["questions"] |= {
        question: [{"numerator": b["name"], "denominator": a["name"], "ratio": summary(1 / (k + 2))} for k, (a, b) in enumerate(pairs)]
        for question, pairs in (("to_first_value", [(rows[0], row) for row in rows[1:]]), ("to_previous_value", zip(rows, rows[1:])))
    }
    return data


def write(folder: Path, files: dict[str, Any]) -> Path:
    """Writes each file into the folder and returns the folder. Text is written unchanged, any other value as JSON."""
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
    return folder


def read(folder: Path, files: dict[str, Any]) -> Results:
    """Writes the files into the folder and reads them. They have their figures already; a fake bench prints them."""
    return read_results(write(folder, files), made_programs.programs(folder.with_name("fake_programs")))


def random_scenes() -> dict[str, Any]:
    data = stored("random.json")
    entry = data["sums"][0]
    sets = {seed: entry["all"] | {"off_percent": off} for seed, off in (("1", 0.123), ("2", 0.987))}
    return data | {"sums": [entry | {"sets": sets}], "scenes": []}


def flight_map() -> dict[str, Any]:
    line = [0.01 * i for i in range(90)]
    return stored("map_bulb.json") | {
        "balls": [[0.1, 0.2, 0.3, 0.2], [0.5, 0.2, 0.3, 0.1]],
        "gates": [[0.3, 0.2, 0.3, 0.05]],
        "passages": [40],
        "x": line,
        "y": line,
        "z": line,
        "clearance": [0.1 + x for x in line],
        "turn": line,
    }


def audit() -> dict[str, Any]:
    data = stored("flight_bulb.json")
    return data | {"rows": [data["rows"][0] | {"value": 1.17, "unit": "deg"}]}


def film() -> dict[str, Any]:
    return stored("film.json") | {"frames": 7200, "frames_rendered": 7200, "seconds": 1800.0}


def everything() -> dict[str, Any]:
    return {
        "bench.json": with_scalar(),
        "threads.json": sweep("threads", "threads", ["1", "2", "4"]),
        "ladder.json": sweep("ladder", "rung", ["reference", "text", "float"]),
        "ablation.json": sweep("ablation", "without", ["none", "hull"]),
        "box-vs-bulb.json": bench("box-vs-bulb"),
        "random.json": random_scenes(),
        "map.json": flight_map(),
        "flight.json": audit(),
        "film.json": film(),
    }
