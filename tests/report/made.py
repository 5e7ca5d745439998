# SPDX-License-Identifier: Apache-2.0
"""Synthetic result files, small and complete."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

from made_flight import audit, film, flight_map
from made_others import code_divergence, race, summary

SETTING = {
    "width": 540,
    "height": 540,
    "iterations": 18,
    "detail": -3.0,
    "power": 8.0,
    "view": "official",
    "without": "",
    "threads": 0,
    "simd_width": 0,
    "chunk": 0,
    "band": 0,
    "block_size": 0,
    "frames": 0,
}
OPERATIONS = {"additions": 10, "multiplications": 20, "divisions": 1, "square_roots": 1}
QUESTIONS = ("mandelbox_to_mandelbulb", "double_to_float", "others_to_host", "to_first_value", "to_previous_value")


def row(
    fractal: str, precision: str, mode: str, backend: str, seconds: float, value: str = "", **setting: Any
) -> dict[str, Any]:
    name = f"{fractal}/{precision}/{mode}/{backend}/0" + (f"/{value}" if value else "")
    return {
        "name": name,
        "fractal": fractal,
        "precision": precision,
        "mode": mode,
        "backend": backend,
        "application": f"{backend}-scalar" if value == "simd-width=1" else backend,
        "device": 0,
        "sweep_value": value,
        "setting": SETTING | setting,
        "unavailable": None,
        "failure": None,
        "platform": "Processor",
        "device_name": "Processor",
        "vendor": "",
        "driver": "",
        "is_gpu": False,
        "instruction_set": "",
        "threads": 2,
        "simd_width": 16,
        "verification": {
            "drawn": True,
            "passed": True,
            "is_expected": False,
            "level": "same bits",
            "text": "same bits",
            "against": "",
            "pixels": 291600,
            "differing": 0,
            "visibly_differing": 0,
            "max_ulps": 0.0,
            "psnr_db": None,
        },
        "context_seconds": 0.0,
        "build_seconds": 0.0,
        "step_factor": None,
        "unsettled": 0.0,
        "work": {"steps": 9, "de_calls": 9, "iterations": 9},
        "operations": 1e9,
        "operations_standard_error": None,
        "samples": [{"run": 0, "round": 0, "kernel": seconds, "wall": seconds, "upload": 0.0, "readback": 0.0, "host": seconds}],
        "figures": {
            "kernel_seconds": summary(seconds),
            "wall_seconds": summary(1.1 * seconds),
            "upload_seconds": 0.0,
            "host_seconds": seconds,
            "readback_seconds": 0.0,
            "unaccounted_share": 0.0,
            "pixels_per_second": 1e6,
            "de_calls_per_second": 1e6,
            "iterations_per_second": 1e7,
            "operations_per_second": 1e9,
            "peak_operations_per_second": 1e10,
            "share_of_peak": 0.1,
            "share_of_peak_standard_error": None,
            "bound_seconds": 0.1 * seconds,
            "speed_up": 1.5,
            "speed_up_interval": None,
            "over_scalar": 2.0,
            "over_scalar_interval": [1.9, 2.1],
        },
    }


def count(fractal: str, iterations: int, view: str = "official") -> dict[str, Any]:
    return {
        "fractal": fractal,
        "precision": "double",
        "mode": "exact",
        "setting": SETTING | {"view": view},
        "pixels": 1000,
        "hits": 300,
        "work": {"steps": 5000, "de_calls": 6000, "iterations": iterations},
        "stages": {stage: OPERATIONS for stage in ("begin", "march", "refine", "normal", "shade")},
        "operations_per_iteration": 25.0,
        "march_de_calls": 5000,
        "march_iterations": iterations,
        "lane_use": [
            {
                "lanes": lanes,
                "together": {"in_steps": 0.8, "in_iterations": 0.7},
                "refilled": {"in_steps": 0.95, "in_iterations": 0.85},
                "together_standard_error": None,
                "refilled_standard_error": None,
            }
            for lanes in (16, 32)
        ],
        "standard_errors": None,
    }


def bench(study: str = "standard", rows: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    """Returns a complete result, with the given rows or, by default, both fractals, precisions and modes on two
    backends."""
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
    portability = {
        "problem": "p",
        "fractal": "mandelbulb",
        "precision": "double",
        "mode": "exact",
        "application": "openmp",
        "by_application_efficiency": 1.0,
        "by_application_efficiency_interval": [0.9, 1.0],
        "by_share_of_peak": 0.1,
        "by_share_of_peak_interval": [0.1, 0.1],
        "platforms": [],
        "not_measured": [],
        "cascade": [{"platform": "Processor", "efficiency": 1.0, "portability": 1.0}],
    }
    return copy.deepcopy(
        {
            "schema": "mandelmarch-bench",
            "version": 2,
            "study": study,
            "seed": 1,
            "runs": 1,
            "warnings": [],
            "environment": {
                "date": "2026-01-02T03:04:05Z",
                "git": {"revision": "0123456789abcdef", "dirty": False},
                "build": {"type": "Release", "compiler": "GNU", "flags": "-O3", "version": "0.1.0"},
                "cpu": {
                    "model": "Processor",
                    "vendor": "V",
                    "cores": 2,
                    "cores_usable": 2,
                    "governor": None,
                    "turbo_disabled": None,
                    "megahertz": "2600",
                    "microcode": "0x1",
                },
                "memory": {"total_bytes": 2**34, "available_bytes": 2**33},
                "os": {"name": "Debian", "kernel": "Linux", "architecture": "x86_64"},
                "backends": [
                    {
                        "name": "openmp",
                        "unavailable": None,
                        "compiler": "GNU",
                        "flags_exact": "-O3",
                        "flags_fast": "-O3",
                        "devices": [{"name": "Processor", "vendor": "V", "driver": "OpenMP", "is_gpu": False}],
                    }
                ],
                "icds": [],
                "variables": {},
                "during": {
                    "load_at_start": 0.1,
                    "load_at_end": 0.2,
                    "megahertz_at_start": 2600.0,
                    "megahertz_at_end": 2600.0,
                    "stolen_share": 0.0,
                    "others_share": 0.0,
                },
            },
            "peaks": [
                {
                    "platform": "Processor",
                    "backend": "openmp",
                    "device": 0,
                    "precision": "double",
                    "operations_per_second": 1e10,
                }
            ],
            "counts": [count("mandelbulb", 12000), count("mandelbox", 36000)],
            "stages": [
                {
                    "fractal": "mandelbulb",
                    "precision": "double",
                    "mode": "exact",
                    "stage": stage,
                    "seconds": [0.1, 0.2, 0.3],
                }
                for stage in ("begin", "march", "normal", "shade", "output", "one go")
            ]
            if study == "profile"
            else [],
            "rows": made,
            "questions": {question: [ratio] if question == "mandelbox_to_mandelbulb" else [] for question in QUESTIONS},
            "portability": [portability],
        }
    )


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
    data["questions"]["to_first_value"] = [
        {"numerator": later["name"], "denominator": rows[0]["name"], "ratio": summary(1 / (k + 2))} for k, later in enumerate(rows[1:])
    ]
    return data


def write(folder: Path, files: dict[str, Any]) -> Path:
    """Writes each file into the folder: text unchanged, other values as JSON. Returns the folder."""
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(data if isinstance(data, str) else json.dumps(data), encoding="utf-8")
    return folder


def random_scenes() -> dict[str, Any]:
    def sums(off: float) -> dict[str, Any]:
        return {
            "scenes": 60,
            "pixels": 1000,
            "off_percent": off,
            "hit_or_miss_percent": 0.0123,
            "scenes_far_off": 3,
            "of_these_short_of_digits": 1,
            "worst_off_percent": 4.04,
        }

    entry = {"fractal": "bulb", "precision": "double", "all": sums(0.5), "sets": {"1": sums(0.123), "2": sums(0.987)}}
    return {
        "schema": "mandelmarch-bench-random",
        "version": 1,
        "backend": "openmp",
        "without": "",
        "width": 61,
        "height": 45,
        "environment": bench()["environment"],
        "sums": [entry],
        "scenes": [],
    }


def everything() -> dict[str, Any]:
    return {
        "bench.json": with_scalar(),
        "threads.json": sweep("threads", "threads", ["1", "2", "4"]),
        "profile.json": bench("profile"),
        "ablation.json": sweep("ablation", "without", ["none", "hull"]),
        "box-vs-bulb.json": bench("box-vs-bulb"),
        "random.json": random_scenes(),
        "map.json": flight_map(),
        "flight.json": audit(),
        "film.json": film(),
        "code_divergence.json": code_divergence(),
        "race.json": race(bench()["environment"]),
    }
