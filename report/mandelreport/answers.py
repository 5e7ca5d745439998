# SPDX-License-Identifier: Apache-2.0
"""Answers on the front page: the values of each sentence, from the results. None if there is no data for one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from markupsafe import Markup

from .backends import Backends
from .bench import Bench, Row
from .models import SCALAR, Costs, traced_work
from .results import Results
from .trace import Place, Trace

FRACTALS = ("mandelbulb", "mandelbox")


def _names(items: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(items))


def counted(file: str, fractal: str, precision: str, what: str, view: str = "official") -> Place:
    """Returns the place of a scene's operation count in exact mode."""
    return Place((file,), f"counts:fractal={fractal}&precision={precision}&mode=exact&setting.view={view}:{what}")


# Factors of a picture's operations. DE evaluations and iterations are the configuration's own counts, over all pixels;
# operations per iteration were counted in a sample of them.
FACTORS = {"calls": "work.de_calls", "iterations": "work.iterations/work.de_calls", "operations": "operations/work.iterations"}


def factors(trace: Trace, file: str, box: str, bulb: str) -> dict[str, Markup]:
    """Returns the factors of one configuration's operations over another's of the same size, and `work`, their
    product."""

    def over(what: str, style: str) -> Markup:
        above, below = (Place((file,), f"rows:name={name}:{what}") for name in (box, bulb))
        return trace.number(above, style, over=below)

    return {name: over(what, "four") for name, what in FACTORS.items()} | {"work": over("operations", "digits")}


def named(text: str) -> Markup:
    """Formats a name, whose digits are not a result."""
    return Markup('<span class="name">{}</span>').format(text)


class Answers:
    """`primary`: the standard study with the most backends and, among these, the most runs."""

    def __init__(self, results: Results, backends: Backends):
        self.results, self.backends = results, backends
        self.trace = Trace(results.files)
        self.primary = results.primary()

    def _standard(self) -> tuple[str, ...]:
        return tuple(bench.name for bench in self.results.study("standard"))

    def _count(self, path: str, files: tuple[str, ...]) -> Markup:
        return self.trace.number(Place(files, path, "count"), "whole")

    def same(self) -> dict[str, Any] | None:
        """Counts exact pictures with the same bits, and measures the error of fast ones."""
        if self.primary is None:
            return None
        timed = f"figures!=null&sweep_value=&backend!={self.backends.reference}"
        files = self._standard()
        every = [row for bench in self.results.study("standard") for row in bench.rows if row.timed and not row.sweep_value]
        exact = [row for row in every if row.mode == "exact" and row.backend != self.backends.reference]
        off = Place(files, f"rows:mode=fast&{timed}:verification.visibly_differing/verification.pixels", "max")
        return {
            "same": self._count(f"rows:mode=exact&{timed}&verification.level=same bits", files),
            "exact": self._count(f"rows:mode=exact&{timed}", files),
            "all": bool(exact) and all(row.verification["level"] == "same bits" for row in exact),
            "backends": self.backends.order(row.backend for row in exact),
            "off": self.trace.number(off, "digits", 100) if any(row.mode == "fast" for row in every) else None,
        }

    def _ratio(self, question: str, numerator: str) -> Markup:
        assert self.primary is not None
        return self.trace.times(self.primary.name, f"questions:{question}:numerator={numerator}:ratio")

    def fastest(self) -> dict[str, Any] | None:
        """Names the fastest backend on the primary machine, with the range of the next best one's times over it."""
        others = self.primary.ratios("others_to_host") if self.primary else []
        if self.primary is None or not others:
            return None
        next_best: dict[str, dict[str, Any]] = {}
        for ratio in others:
            kept = next_best.setdefault(ratio["denominator"], ratio)
            if ratio["ratio"]["median"] < kept["ratio"]["median"]:
                next_best[ratio["denominator"]] = ratio
        ends = [pick(next_best.values(), key=lambda r: r["ratio"]["median"]) for pick in (min, max)]
        name = self.primary.name
        return {
            "host": self.backends.host,
            "host_wins": all(ratio["ratio"]["median"] > 1 for ratio in others),
            "machines": _names(bench.machine for bench in self.results.whole() if bench.host_wins()),
            "slower": self.trace.number(Place((name,), "questions:others_to_host:ratio.count>0", "holm"), "whole"),
            "compared": self._count("questions:others_to_host:ratio.count>0", (name,)),
            "ends": [self._end(r) for r in ends],
        }

    def _end(self, ratio: dict[str, Any]) -> dict[str, Any]:
        assert self.primary is not None
        fractal, precision, mode, backend = ratio["numerator"].split("/")[:4]
        return {
            "ratio": self._ratio("others_to_host", ratio["numerator"]),
            "case": f"{backend}; {fractal}, {precision}, {mode}",
            "work": traced_work(self.trace, self.primary.name, ratio["numerator"], ratio["denominator"]),
        }

    def cost(self) -> dict[str, Any] | None:
        """Compares the models that compile the scalar kernel unchanged with openmp's scalar kernel."""
        return Costs(self.primary, self.backends).answer(self.trace) if self.primary else None

    def speed_up(self, key: str, fractal: str, precision: str, mode: str) -> tuple[Bench, Row] | None:
        """Returns the host's fastest configuration with this speed-up, from the study with the most runs, standard
        studies first."""
        rows = [
            (bench, row)
            for bench in self.results.benches
            if bench.study in ("standard", "simd-widths")
            for row in bench.timed(fractal=fractal, precision=precision, mode=mode, backend=self.backends.host)
            if row.figures[key] is not None
        ]
        order = [(b is self.primary, b.study == "standard", b.data["runs"], r.figures[key]) for b, r in rows]
        return rows[order.index(max(order))] if rows else None

    def speed_ups(self) -> dict[str, Any] | None:
        """Returns the host's figures in float by mode, exact first: speed-ups over the serial reference and over the
        scalar kernel on the same threads, and the scalar kernel's operations over its own; one number per fractal."""
        modes = {mode: found for mode in ("exact", "fast") if (found := self._speed_ups_of(mode))}
        return {"modes": modes, "host": self.backends.host, "size": self.primary.size} if self.primary and "exact" in modes else None

    def _speed_ups_of(self, mode: str) -> dict[str, Any] | None:
        keys = ("speed_up", "over_scalar")
        serial, scalar = ([self.speed_up(key, f, "float", mode) for f in FRACTALS] for key in keys)
        if None in serial or None in scalar:
            return None

        def number(key: str, bench: Bench, row: Row) -> Markup:
            at = f"rows:name={row.name}:figures:{key}"
            return self.trace.with_interval(bench.name, at, f"{at}_interval")

        def work(bench: Bench, row: Row) -> Markup:
            baseline = "/".join([row.fractal, row.precision, row.mode, self.backends.host, "0", SCALAR])
            return traced_work(self.trace, bench.name, baseline, row.name)

        return {
            "serial": [number(keys[0], *one) for one in serial if one],
            "scalar": [number(keys[1], *one) for one in scalar if one],
            "work": [work(*one) for one in scalar if one],
        }

    def box_or_bulb(self) -> dict[str, Any] | None:
        """Returns how much longer the Mandelbox takes, with the counted factors of its operations, in double and exact
        mode."""
        kinds = [("double", "exact"), ("float", "fast")]
        ratios = [self._found("mandelbox_to_mandelbulb", f"mandelbox/{p}/{m}/{self.backends.host}/0") for p, m in kinds]
        if self.primary is None or None in ratios:
            return None
        name = self.primary.name
        box, bulb = (f"{fractal}/double/exact/{self.backends.host}/0" for fractal in FRACTALS[::-1])
        return {
            "size": self.primary.size,
            "sample": self.trace.number(counted(name, "mandelbox", "double", "pixels"), "whole"),
            "ratios": [
                (self._ratio("mandelbox_to_mandelbulb", r["numerator"]), p, m, verdict(r)) for r, (p, m) in zip(ratios, kinds)
            ],
            **factors(self.trace, name, box, bulb),
        }

    def _found(self, question: str, numerator: str) -> dict[str, Any] | None:
        return self.primary.ratio(question, numerator) if self.primary else None

    def float_or_double(self) -> dict[str, Any] | None:
        """Returns the cost of double on the host, and the error of float in pictures of random scenes."""
        ratios = {
            mode: [self._found("double_to_float", f"{f}/double/{mode}/{self.backends.host}/0") for f in FRACTALS]
            for mode in ("exact", "fast")
        }
        if self.primary is None or any(ratio is None for two in ratios.values() for ratio in two):
            return None
        random = next((data for data in self.results.random if not data["without"]), None)
        file = self.results.name_of(random) if random else ""
        found = {(entry["fractal"], entry["precision"]) for entry in random["sums"]} if random else set()
        off = None
        if all((fractal, p) in found for fractal in ("bulb", "box") for p in ("float", "double")):
            off = {
                p: [self.trace.one(file, f"sums:fractal={f}&precision={p}:all.off_percent") for f in ("bulb", "box")]
                for p in ("float", "double")
            }
        return {
            "float_wins": all((ratio["ratio"]["interval"] or [0])[0] > 1 for two in ratios.values() for ratio in two),
            "exact": [self._ratio("double_to_float", ratio["numerator"]) for ratio in ratios["exact"]],
            "fast": [self._ratio("double_to_float", ratio["numerator"]) for ratio in ratios["fast"]],
            "off": off,
        }

    def gpu(self) -> dict[str, Any] | None:
        """Compares a measured GPU, or the prediction for one, with the host, both at the film's size."""
        measured = [(b, r) for b in self.results.benches for r in b.rows if r.timed and r.is_gpu]
        if measured:
            bench, row = max(measured, key=lambda one: one[1].figures["pixels_per_second"])
            return {
                "measured": self.trace.times(bench.name, f"rows:name={row.name}:figures:kernel_seconds", 1e3),
                "device": row.device_name,
                "what": f"{row.fractal}, {row.precision}, {row.mode}",
            }
        expected = next((n for n, text in self.results.files.items() if str(text).startswith("K40 on paper")), None)
        rows = [self._at_film_size(fractal) for fractal in FRACTALS]
        if expected is None or None in rows:
            return None
        pairs = []
        for fractal, (bench, row) in zip(FRACTALS, rows):
            place = Place((expected,), f"{fractal} float fast openacc:10")
            at = f"rows:name={row.name}:figures:kernel_seconds"
            pairs.append(
                {
                    "predicted": self.trace.number(place),
                    "host": self.trace.times(bench.name, at, 1e3),
                    "times": self.trace.number(Place((bench.name,), f"{at}:median"), scale=1e3, over=place),
                }
            )
        size = [self.trace.one(rows[0][0].name, f"rows:name={rows[0][1].name}:setting.{k}", "plain") for k in ("width", "height")]
        return {"predicted": pairs, "size": size, "host": self.backends.host}

    def _at_film_size(self, fractal: str) -> Any:
        rows = [
            (bench, row)
            for bench in self.results.benches
            if bench.study in ("standard", "resolution")
            for row in bench.timed(fractal=fractal, precision="float", mode="fast", backend=self.backends.host)
            if (row.setting["width"], row.setting["height"]) == (1920, 1080)
        ]
        return max(rows, key=lambda one: (one[0].data["runs"], one[1].kernel.count), default=None)

    def film(self) -> dict[str, Any] | None:
        """Returns frames, seconds and seconds per frame of the first film with a summary."""
        for name, data in self.results.files.items():
            if isinstance(data, dict) and data.get("schema") == "mandelmarch-film" and data["frames_rendered"]:
                one = self.trace.one
                return {
                    "frames": one(name, "frames_rendered", "whole"),
                    "seconds": one(name, "seconds", "whole"),
                    "minutes": one(name, "seconds", "whole", 1 / 60),
                    "a_frame": one(name, "seconds/frames_rendered"),
                    "size": [one(name, "width", "plain"), one(name, "height", "plain")],
                    "samples": one(name, "samples", "plain"),
                    "threads": one(name, "threads", "plain") if data["threads"] else None,
                    "device": data["device"]["name"],
                    "what": f"{data['precision']}, {data['mode']}",
                }
        return None


MARGIN = 1.02  # as in bench compare


def verdict(ratio: dict[str, Any] | None) -> Markup:
    """Describes a ratio of times: slower, faster, the same within the margin, or undecided."""
    interval = ratio["ratio"]["interval"] if ratio else None
    if interval is None:
        return Markup("undecided")
    low, high = interval
    if 1 / MARGIN <= low and high <= MARGIN:
        return Markup("the same within {}").format(named(f"{100 * (MARGIN - 1):.0f} %"))
    return Markup("it is slower" if low > 1 else "it is faster" if high < 1 else "undecided")
