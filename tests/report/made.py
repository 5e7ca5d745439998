# SPDX-License-Identifier: Apache-2.0
"""Results for tests: parts of the stored results, some with other values."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import made_programs
from mandelreport.results import RESULTS, Files, Results, read_results

STORED = Files(Path(__file__).parents[2] / RESULTS, made_programs.TESTED)


def stored(name: str) -> Any:
    return copy.deepcopy(STORED.json(name.removesuffix(".json")))


def bench(backends: tuple[str, ...] = ("openmp", "vulkan")) -> dict[str, Any]:
    """Returns the stored standard study with the rows of these backends, among them those of the scalar kernel."""
    data = stored("bench.json")
    data["rows"] = [row for row in data["rows"] if row["backend"] in backends]
    names = {row["name"] for row in data["rows"]}
    for question, entries in data["questions"].items():
        data["questions"][question] = [entry for entry in entries if {entry["numerator"], entry["denominator"]} <= names]
    for ranking in data["winners"]:
        ranking["others"] = [other for other in ranking["others"] if other["name"] in names]
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


def audit() -> dict[str, Any]:
    data = stored("flight_bulb.json")
    return data | {"rows": [data["rows"][0] | {"value": 1.17, "unit": "deg"}]}


def film() -> dict[str, Any]:
    return stored("film.json") | {"frames": 7200, "frames_rendered": 7200, "seconds": 1800.0}


def everything() -> dict[str, Any]:
    studies = {name: stored(name) for name in ("threads.json", "ladder.json", "ablation.json", "box-vs-bulb.json")}
    flights = {"map.json": stored("map_bulb.json"), "flight.json": audit(), "film.json": film()}
    return {"bench.json": bench(), "random.json": random_scenes(), **studies, **flights}
