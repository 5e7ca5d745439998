# SPDX-License-Identifier: Apache-2.0
"""Synthetic files of tools/code_divergence.py and bench race."""

from __future__ import annotations

from typing import Any


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


def code_divergence() -> dict[str, Any]:
    def model(name: str, lines: int, distances: dict[str, float]) -> dict[str, Any]:
        return {"backend": name, "lines": lines, "lines_of_job": 0, "lines_of_kernel": 987, "distances": distances}

    models = [model("openmp", 1234, {"openmp": 0, "vulkan": 0.4321}), model("vulkan", 321, {"openmp": 0.4321, "vulkan": 0})]
    return {
        "schema": "mandelmarch-code-divergence",
        "version": 2,
        "models": models,
        "convergence": 0.5679,
        "convergence_without_shared_kernel": 0.0123,
    }


def race(environment: dict[str, Any]) -> dict[str, Any]:
    def program(name: str, verdict: str, why: str | None, seconds: float | None) -> dict[str, Any]:
        return {
            "name": name,
            "ours": name == "openmp",
            "verdict": verdict,
            "why": why,
            "exit_code": 0,
            "signal": None,
            "picture": {"width": 60, "height": 40, "differing": 24, "visibly_differing": 3, "first_x": 1, "first_y": 2, "psnr_db": 40.5},
            "memory": 3 * 2**20,
            "wall": summary(seconds) if seconds else None,
            "times_ours": 7.77 if seconds else None,
            "times_ours_interval": None,
            "samples": [{"round": 0, "wall": seconds, "processor": 0.1}] if seconds else [],
        }

    programs = [program("openmp", "close", None, 0.5), program("./theirs", "close", None, 0.4567), program("./bad", "WRONG", "24 pixels", None)]
    named = {key: environment[key] for key in ("date", "git", "build", "cpu", "memory", "os", "backends", "icds", "variables")}
    return {
        "schema": "mandelmarch-race",
        "version": 2,
        "environment": named,
        "fractal": "mandelbox",
        "width": 60,
        "height": 40,
        "parameters": "",
        "limit": 60,
        "rounds": 6,
        "warnings": [],
        "programs": programs,
    }
