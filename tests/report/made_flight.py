# SPDX-License-Identifier: Apache-2.0
"""Synthetic output of flythrough."""

from __future__ import annotations

from typing import Any


def flight_map() -> dict[str, Any]:
    line = [0.01 * i for i in range(90)]
    return {
        "format": "mandelmarch flight map 1",
        "fractal": "mandelbulb",
        "seed": 1,
        "frames_per_second": 30,
        "hull": {"shape": "sphere", "size": 1.1},
        "safety": 0.8,
        "ball_count": 2,
        "gate_count": 1,
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
    return {
        "schema": 1,
        "fractal": "mandelbulb",
        "seed": 1,
        "frames": 90,
        "promises_kept": True,
        "bars_missed": 0,
        "rows": [
            {
                "name": "largest turn per frame",
                "value": 1.17,
                "bar": 1.2,
                "at_most": True,
                "promise": True,
                "unit": "deg",
                "kept": True,
                "worst": "frame 7",
            }
        ],
    }


def film() -> dict[str, Any]:
    return {
        "schema": "mandelmarch-film",
        "version": 1,
        "fractal": "mandelbulb",
        "seed": 1,
        "frames": 7200,
        "frames_per_second": 30,
        "width": 1920,
        "height": 1080,
        "samples": 2,
        "backend": "openmp",
        "device": {"name": "Processor", "driver": "OpenMP", "is_gpu": False},
        "precision": "float",
        "mode": "fast",
        "threads": 2,
        "processes": 1,
        "frames_rendered": 7200,
        "seconds": 1800.0,
        "seconds_per_frame": 0.25,
    }
