# SPDX-License-Identifier: Apache-2.0
"""Answers on the front page. Each public method of Answers returns the values for the sentences of one answer, or None
if there is no data for it."""

from typing import Any

from markupsafe import Markup

from .bench import SCALAR, Backends, Bench, Row
from .models import Costs, work_over
from .results import Results
from .text import Number

FRACTALS = ("mandelbulb", "mandelbox")
FILM_SIZE = (1920, 1080)  # pixels


# A picture's operations are the product of its DE evaluations, its iterations per evaluation, and its operations per
# iteration. The first two were counted over all pixels of the configuration, the third in a sample of its pixels.
def factors(bench: Bench, box: Row, bulb: Row) -> dict[str, Markup]:
    """Returns each factor of the picture `box` divided by that of the picture `bulb`, of the same size, and `work`, the
    product of these ratios."""

    def over(what: str, base: str = "") -> Number:
        of = [Number.of_row(bench, row, what) / Number.of_row(bench, row, base) if base else Number.of_row(bench, row, what) for row in (box, bulb)]
        return of[0] / of[1]

    return {
        "calls": over("/work/de_calls").html("four"),
        "iterations": over("/work/iterations", "/work/de_calls").html("four"),
        "operations": over("/operations", "/work/iterations").html("four"),
        "work": over("/operations").html(),
    }


def named(text: str) -> Markup:
    """Formats a name that contains digits. The markup shows that they are not a result."""
    return Markup('<span class="name">{}</span>').format(text)


def _count(rows: list[tuple[Bench, Row]]) -> Markup:
    return Number.count([f"{bench.name}#{bench.at(row)}" for bench, row in rows]).html("whole")


class Answers:
    """`primary`: the standard study with the most backends and, of several such studies, the one with the most runs."""

    def __init__(self, results: Results, backends: Backends):
        self.results, self.backends = results, backends
        self.primary = results.primary()

    def same(self) -> dict[str, Any] | None:
        """Returns the number of exact pictures with the same bits, and the largest percentage of pixels that are off in
        a fast picture."""
        if self.primary is None:
            return None
        timed = self.results.timed(("standard",), sweep_value="")
        every = [(bench, row) for bench, row in timed if row.backend != self.backends.reference]
        exact = [(bench, row) for bench, row in every if row.mode == "exact"]
        same = [(bench, row) for bench, row in exact if row.verification["level"] == "same bits"]
        fast = [(bench, row) for bench, row in every if row.mode == "fast"]
        off = None
        if fast:
            differing, pixels = (
                Number.of_row(*max(fast, key=lambda one: one[1].visibly_off), f"/verification/{what}")
                for what in ("visibly_differing", "pixels")
            )
            off = (100 * (differing / pixels)).html()
        return {
            "same": _count(same),
            "exact": _count(exact),
            "all": bool(exact) and len(same) == len(exact),
            "backends": self.backends.order(row.backend for _, row in exact),
            "off": off,
        }

    def _ratio(self, question: str, numerator: str) -> Markup:
        assert self.primary is not None
        return self.results.times(self.primary.name, self.primary.ratio_at(question, numerator))

    def fastest(self) -> dict[str, Any] | None:
        """Returns the host, the machines on which the host is the fastest backend, and the range of the next best
        backend's times, relative to the host's, in the primary study."""
        others = self.primary.ratios("others_to_host") if self.primary else []
        if self.primary is None or not others:
            return None
        next_best: dict[str, dict[str, Any]] = {}
        for ratio in others:
            kept = next_best.setdefault(ratio["denominator"], ratio)
            if ratio["ratio"]["median"] < kept["ratio"]["median"]:
                next_best[ratio["denominator"]] = ratio
        ends = [pick(next_best.values(), key=lambda r: r["ratio"]["median"]) for pick in (min, max)]
        places = [f"{self.primary.name}#{self.primary.ratio_at('others_to_host', ratio['numerator'])}" for ratio in others]
        return {
            "host": self.backends.host,
            "host_wins": self.primary.wins(self.backends.host),
            "machines": list(dict.fromkeys(bench.machine for bench in self.results.whole() if bench.wins(self.backends.host))),
            "slower": Number.count(self._slower(self.primary)).html("whole"),
            "compared": Number.count(places).html("whole"),
            "ends": [self._end(r) for r in ends],
        }

    def _slower(self, bench: Bench) -> list[str]:
        """Returns the place of each verdict that a backend is slower than the host. Includes only cases (fractal,
        precision, mode) in which the host is the fastest backend."""
        return [
            f"{bench.name}#/winners/{at}/others/{k}/verdict"
            for at, (ranking, fastest) in enumerate(zip(bench.data["winners"], bench.fastest()))
            for k, other in enumerate(ranking["others"])
            if fastest.backend == self.backends.host != bench.named(other["name"]).backend and other["verdict"] == "SLOWER"
        ]

    def _end(self, ratio: dict[str, Any]) -> dict[str, Any]:
        assert self.primary is not None
        fractal, precision, mode, backend = ratio["numerator"].split("/")[:4]
        return {
            "ratio": self._ratio("others_to_host", ratio["numerator"]),
            "case": f"{backend}; {fractal}, {precision}, {mode}",
            "work": work_over(self.primary, ratio["numerator"], ratio["denominator"]),
        }

    def cost(self) -> dict[str, Any] | None:
        """Returns the cost of each programming model that compiles the scalar kernel unchanged, relative to openmp's
        scalar kernel."""
        return Costs(self.primary, self.backends).answer(self.results) if self.primary else None

    def speed_up(self, key: str, fractal: str, precision: str, mode: str) -> tuple[Bench, Row] | None:
        """Returns the host's configuration with the highest value of the speed-up `key`. Prefers the primary study,
        then standard studies, then studies with more runs."""
        timed = self.results.timed(
            ("standard", "simd-widths"), fractal=fractal, precision=precision, mode=mode, backend=self.backends.host
        )
        rows = [one for one in timed if one[1].figures[key] is not None]
        order = [(b is self.primary, b.study == "standard", b.data["runs"], r.figures[key]) for b, r in rows]
        return rows[order.index(max(order))] if rows else None

    def speed_ups(self) -> dict[str, Any] | None:
        """Returns the host's figures in float, by mode, exact first. Each mode has three lists with a number per
        fractal: the speed-up over the serial reference, the speed-up over the scalar kernel on the same threads, and
        the scalar kernel's operations divided by the host's."""
        modes = {mode: found for mode in ("exact", "fast") if (found := self._speed_ups_of(mode))}
        return {"modes": modes, "host": self.backends.host, "size": self.primary.size} if self.primary and "exact" in modes else None

    def _speed_ups_of(self, mode: str) -> dict[str, Any] | None:
        keys = ("speed_up", "over_scalar")
        serial, scalar = ([self.speed_up(key, f, "float", mode) for f in FRACTALS] for key in keys)
        if None in serial or None in scalar:
            return None

        def number(key: str, bench: Bench, row: Row) -> Markup:
            at = bench.at(row, f"/figures/{key}")
            return self.results.with_interval(bench.name, at, f"{at}_interval")

        def work(bench: Bench, row: Row) -> Markup:
            return work_over(bench, "/".join([*row.kind, self.backends.host, "0", SCALAR]), row.name)

        factors = [work(*one) for one in scalar if one]
        return {
            "serial": [number(keys[0], *one) for one in serial if one],
            "scalar": [number(keys[1], *one) for one in scalar if one],
            # Empty if no factor shows in the printed digits.
            "work": factors if any(factor.striptags() != "1.00" for factor in factors) else [],
        }

    def box_or_bulb(self) -> dict[str, Any] | None:
        """Returns the Mandelbox's times divided by the Mandelbulb's and, for double in exact mode, the counted factors
        of their operations."""
        kinds = [("double", "exact"), ("float", "fast")]
        ratios = [self._found("mandelbox_to_mandelbulb", f"mandelbox/{p}/{m}/{self.backends.host}/0") for p, m in kinds]
        if self.primary is None or None in ratios:
            return None
        box, bulb = (self.primary.named(f"{fractal}/double/exact/{self.backends.host}/0") for fractal in FRACTALS[::-1])
        return {
            "size": self.primary.size,
            "ratios": [
                (self._ratio("mandelbox_to_mandelbulb", r["numerator"]), p, m, verdict(r)) for r, (p, m) in zip(ratios, kinds)
            ],
            **factors(self.primary, box, bulb),
        }

    def _found(self, question: str, numerator: str) -> dict[str, Any] | None:
        return self.primary.ratio(question, numerator) if self.primary else None

    def float_or_double(self) -> dict[str, Any] | None:
        """Returns the ratio of the host's times in double and in float, and float's error in pictures of random
        scenes."""
        ratios = {
            mode: [self._found("double_to_float", f"{f}/double/{mode}/{self.backends.host}/0") for f in FRACTALS]
            for mode in ("exact", "fast")
        }
        if self.primary is None or any(ratio is None for two in ratios.values() for ratio in two):
            return None
        random = next((data for data in self.results.random if not data["without"]), None)
        file = next((name for name, data in self.results.files.items() if data is random), "")
        kinds = [(entry["fractal"], entry["precision"]) for entry in random["sums"]] if random else []
        off = None
        if all((fractal, p) in kinds for fractal in ("bulb", "box") for p in ("float", "double")):
            off = {
                p: [self.results.number(file, f"/sums/{kinds.index((f, p))}/all/off_percent").html() for f in ("bulb", "box")]
                for p in ("float", "double")
            }
        return {
            "float_wins": all((ratio["ratio"]["interval"] or [0])[0] > 1 for two in ratios.values() for ratio in two),
            "exact": [self._ratio("double_to_float", ratio["numerator"]) for ratio in ratios["exact"]],
            "fast": [self._ratio("double_to_float", ratio["numerator"]) for ratio in ratios["fast"]],
            "off": off,
        }

    def gpu(self) -> dict[str, Any] | None:
        """Returns the times of the fastest measured GPU, and the host's times, all at the film's size."""
        kinds = [{"fractal": fractal, "precision": "float", "mode": "fast"} for fractal in FRACTALS]
        rows = [self.results.of_size(FILM_SIZE, **kind, backend=self.backends.host) for kind in kinds]
        gpus = [self.results.fastest_gpu(FILM_SIZE, **kind) for kind in kinds]
        if None in rows or None in gpus:
            return None
        size = [Number.of_row(*rows[0], f"/setting/{key}").html("plain") for key in ("width", "height")]
        return {"measured": [self._beside(gpu, row) for gpu, row in zip(gpus, rows)], "size": size, "host": self.backends.host}

    def _beside(self, gpu: tuple[Bench, Row], host: tuple[Bench, Row]) -> dict[str, Any]:
        """Returns the times of a GPU's row and of the host's row for the same picture."""
        kernel = "/figures/kernel_seconds"
        return {
            "device": gpu[1].device_name,
            "backend": gpu[1].backend,
            "gpu": (1e3 * Number.of_row(*gpu, f"{kernel}/median")).html(),
            "host": self.results.times(host[0].name, host[0].at(host[1], kernel), 1e3),
            "times": (Number.of_row(*host, f"{kernel}/median") / Number.of_row(*gpu, f"{kernel}/median")).html(),
        }

    def film(self) -> dict[str, Any] | None:
        """Returns frames, seconds and seconds per frame of the first film with a summary."""
        for name, data in self.results.files.items():
            if isinstance(data, dict) and data.get("schema") == "mandelmarch-film" and data["frames_rendered"]:
                frames, seconds = (self.results.number(name, f"/{key}") for key in ("frames_rendered", "seconds"))
                width, height, samples = (self.results.number(name, f"/{key}").html("plain") for key in ("width", "height", "samples"))
                return {
                    "frames": frames.html("whole"),
                    "seconds": seconds.html("whole"),
                    "minutes": ((1 / 60) * seconds).html("whole"),
                    "a_frame": (seconds / frames).html(),
                    "size": [width, height],
                    "samples": samples,
                    "threads": self.results.number(name, "/threads").html("plain") if data["threads"] else None,
                    "device": data["device"]["name"],
                    "what": f"{data['precision']}, {data['mode']}",
                }
        return None


MARGIN = 1.02  # as in bench compare


def verdict(ratio: dict[str, Any] | None) -> Markup:
    """Returns a word for a ratio of times: slower, faster, the same within the margin, or undecided."""
    interval = ratio["ratio"]["interval"] if ratio else None
    if interval is None:
        return Markup("undecided")
    low, high = interval
    if 1 / MARGIN <= low and high <= MARGIN:
        return Markup("the same within {}").format(named(f"{100 * (MARGIN - 1):.0f} %"))
    return Markup("it is slower" if low > 1 else "it is faster" if high < 1 else "undecided")
