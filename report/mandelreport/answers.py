# SPDX-License-Identifier: Apache-2.0
"""Answers on the front page. Each public method of Answers returns the values for the sentences of one answer, or None
if there is no data for it."""

from collections.abc import Callable
from typing import Any

from markupsafe import Markup

from .bench import SAME_WORK, SCALAR, Backends, Bench, Ratio, Row, count
from .results import Results
from .text import Number

FRACTALS = ("mandelbulb", "mandelbox")
FILM_SIZE = (1920, 1080)  # pixels
MARGIN = 1.02  # as in bench compare


# A picture's operations are the product of its DE evaluations, its iterations per evaluation, and its operations per
# iteration. The first two were counted over all pixels of the configuration, the third in a sample of its pixels.
def factors(box: Row, bulb: Row) -> dict[str, Markup]:
    """Returns each factor of the picture `box` divided by that of the picture `bulb`, of the same size, and `work`, the
    product of these ratios."""

    def over(what: str, base: str = "") -> Number:
        of = [row.number(what) / row.number(base) if base else row.number(what) for row in (box, bulb)]
        return of[0] / of[1]

    return {
        "calls": over("/work/de_calls").html("four"),
        "iterations": over("/work/iterations", "/work/de_calls").html("four"),
        "operations": over("/operations", "/work/iterations").html("four"),
        "work": over("/operations").html(),
    }


def work_over(bench: Bench, name: str, over: str) -> Markup:
    """Returns the counted operations of a row divided by those of the row `over`."""
    above, below = (bench.named(of).number("/operations") for of in (name, over))
    return (above / below).html()


def verdict(ratio: Ratio) -> Markup:
    """Returns a word for a ratio of times: slower, faster, the same within the margin, or undecided."""
    if ratio.times.interval is None:
        return Markup("undecided")
    low, high = ratio.times.interval
    if 1 / MARGIN <= low and high <= MARGIN:
        return Markup('the same within <span class="name">{:.0f} %</span>').format(100 * (MARGIN - 1))
    return Markup("it is slower" if low > 1 else "it is faster" if high < 1 else "undecided")


class Costs:
    """The cost of a programming model is its time divided by that of the host's scalar kernel for the same work, per thread.
    `speeds`: by backend, the rows that do the same work as the scalar kernel without explicit SIMD, with their
    speeds per thread, relative to the scalar kernel's."""

    def __init__(self, bench: Bench, backends: Backends):
        self.bench, self.host = bench, backends.host
        # Each tuple: speed, the scalar kernel's threads divided by the row's, row.
        self.speeds: dict[str, list[tuple[float, float, Row]]] = {}
        for row in bench.rows:
            # A driver's compiler may vectorise the kernel, on a number of threads of its own.
            if row.is_gpu or row.simd_width != 1 or row.backend == self.host or row.backend not in bench.in_cpp:
                continue
            work = row.work_over_scalar(self.host) if row.timed else None
            if work is None or abs(work - 1) > SAME_WORK:
                continue
            scalar = row.scalar(self.host)
            if scalar is not None and row.figures["over_scalar"] is not None:
                threads = scalar.threads / row.threads
                self.speeds.setdefault(row.backend, []).append((threads * row.figures["over_scalar"], threads, row))

    def _end(self, pick: Callable[..., Any], speeds: list[tuple[float, float, Row]]) -> Markup:
        _, threads, row = pick(speeds, key=lambda one: one[0])
        at = f"{row.at}/figures/over_scalar"
        return self.bench.with_interval(at, f"{at}_interval", threads)

    def answer(self) -> dict[str, Any] | None:
        """Returns the slowest and the fastest case of each model. Models that run on as many threads as the scalar
        kernel come before models that run on one thread."""
        groups: dict[str, list[dict[str, Any]]] = {}
        for backend, speeds in sorted(self.speeds.items(), key=lambda item: item[1][0][1]):
            words = "on one thread, speed per thread" if speeds[0][1] > 1 else "On as many threads"
            ends = {"least": self._end(min, speeds), "most": self._end(max, speeds)}
            groups.setdefault(words, []).append({"backend": backend, **ends})
        if not groups:
            return None
        every = [one for speeds in self.speeds.values() for one in speeds]
        cases = self.bench.timed(backend=next(iter(self.speeds)), sweep_value="")
        return {
            "groups": list(groups.items()),
            "backends": [model["backend"] for models in groups.values() for model in models],
            "least": self._end(min, every),
            "most": self._end(max, every),
            "cheap": min(speed for speed, *_ in every) > 0.8,
            "cases": count(cases),
            "size": self.bench.size,
        }


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
        every = [row for row in self.results.timed(("standard",), sweep_value="") if row.backend != self.backends.reference]
        exact, fast = ([row for row in every if row.mode == mode] for mode in ("exact", "fast"))
        same = [row for row in exact if row.verification["level"] == "same bits"]
        off = None
        if fast:
            worst = max(fast, key=lambda row: row.visibly_off)
            off = (100 * (worst.number("/verification/visibly_differing") / worst.number("/verification/pixels"))).html()
        return {
            "same": count(same),
            "exact": count(exact),
            "all": bool(exact) and len(same) == len(exact),
            "backends": self.backends.order(row.backend for row in exact),
            "off": off,
        }

    def fastest(self) -> dict[str, Any] | None:
        """Returns the host, the machines on which the host is the fastest backend, and the range of the next best
        backend's times, relative to the host's, in the primary study."""
        others = self.primary.ratios("others_to_host") if self.primary else []
        if self.primary is None or not others:
            return None
        next_best: dict[str, Ratio] = {}
        for ratio in others:
            next_best[ratio.denominator] = min(next_best.get(ratio.denominator, ratio), ratio, key=lambda one: one.times.median)
        ends = [pick(next_best.values(), key=lambda one: one.times.median) for pick in (min, max)]
        host = self.backends.host
        return {
            "host": host,
            "host_wins": self.primary.wins(host),
            "machines": list(dict.fromkeys(bench.machine for bench in self.results.whole() if bench.wins(host))),
            "slower": Number.count(self._slower(self.primary)).html("whole"),
            "compared": Number.count([f"{self.primary.name}#{ratio.at}" for ratio in others]).html("whole"),
            "ends": [self._end(ratio) for ratio in ends],
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

    def _end(self, ratio: Ratio) -> dict[str, Any]:
        fractal, precision, mode, backend = ratio.numerator.split("/")[:4]
        case = f"{backend}; {fractal}, {precision}, {mode}"
        return {"ratio": ratio.html(), "case": case, "work": work_over(ratio.bench, ratio.numerator, ratio.denominator)}

    def cost(self) -> dict[str, Any] | None:
        """Returns the cost of each programming model that compiles the scalar kernel unchanged, relative to openmp's
        scalar kernel."""
        return Costs(self.primary, self.backends).answer() if self.primary else None

    def speed_up(self, key: str, fractal: str, precision: str, mode: str) -> Row | None:
        """Returns the host's configuration with the highest value of the speed-up `key`. Prefers the primary study,
        then standard studies, then studies with more runs."""
        kind = {"fractal": fractal, "precision": precision, "mode": mode, "backend": self.backends.host}
        rows = [row for row in self.results.timed(("standard", "simd-widths"), **kind) if row.figures[key] is not None]

        def order(row: Row) -> tuple[bool, bool, int, float]:
            return row.bench is self.primary, row.bench.study == "standard", row.bench.data["runs"], row.figures[key]

        return max(rows, key=order, default=None)

    def speed_ups(self) -> dict[str, Any] | None:
        """Returns the host's figures in float, by mode, exact first. Each mode has three lists with a number per
        fractal: the speed-up over the serial reference, the speed-up over the scalar kernel on the same threads, and
        the scalar kernel's operations divided by the host's."""
        modes = {mode: found for mode in ("exact", "fast") if (found := self._speed_ups_of(mode))}
        return {"modes": modes, "host": self.backends.host, "size": self.primary.size} if self.primary and "exact" in modes else None

    def _speed_ups_of(self, mode: str) -> dict[str, Any] | None:
        keys = ("speed_up", "over_scalar")
        serial, scalar = ([row for f in FRACTALS if (row := self.speed_up(key, f, "float", mode))] for key in keys)
        if len(serial) < len(FRACTALS) or len(scalar) < len(FRACTALS):
            return None

        def number(key: str, row: Row) -> Markup:
            at = f"{row.at}/figures/{key}"
            return row.bench.with_interval(at, f"{at}_interval")

        factors = [work_over(row.bench, "/".join([*row.kind, self.backends.host, "0", SCALAR]), row.name) for row in scalar]
        return {
            "serial": [number(keys[0], row) for row in serial],
            "scalar": [number(keys[1], row) for row in scalar],
            # Empty if no factor shows in the printed digits.
            "work": factors if any(factor.striptags() != "1.00" for factor in factors) else [],
        }

    def _ratios(self, question: str, kinds: list[str]) -> list[Ratio]:
        """Returns the ratios of the host's rows of these kinds, or none if one is missing."""
        names = [f"{kind}/{self.backends.host}/0" for kind in kinds]
        found = [ratio for name in names if self.primary and (ratio := self.primary.ratio(question, name))]
        return found if len(found) == len(kinds) else []

    def box_or_bulb(self) -> dict[str, Any] | None:
        """Returns the Mandelbox's times divided by the Mandelbulb's and, for double in exact mode, the counted factors
        of their operations."""
        kinds = [("double", "exact"), ("float", "fast")]
        ratios = self._ratios("mandelbox_to_mandelbulb", [f"mandelbox/{p}/{m}" for p, m in kinds])
        if self.primary is None or not ratios:
            return None
        box, bulb = (self.primary.named(f"{fractal}/double/exact/{self.backends.host}/0") for fractal in FRACTALS[::-1])
        return {
            "size": self.primary.size,
            "ratios": [(ratio.html(), *kind, verdict(ratio)) for ratio, kind in zip(ratios, kinds)],
            **factors(box, bulb),
        }

    def float_or_double(self) -> dict[str, Any] | None:
        """Returns the ratio of the host's times in double and in float, and float's error in pictures of random
        scenes."""
        exact, fast = (self._ratios("double_to_float", [f"{f}/double/{mode}" for f in FRACTALS]) for mode in ("exact", "fast"))
        if not exact or not fast:
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
            "float_wins": all((ratio.times.interval or [0])[0] > 1 for ratio in exact + fast),
            "exact": [ratio.html() for ratio in exact],
            "fast": [ratio.html() for ratio in fast],
            "off": off,
        }

    def gpu(self) -> dict[str, Any] | None:
        """Returns the times of the fastest measured GPU, and the host's times, all at the film's size."""
        kinds = [{"fractal": fractal, "precision": "float", "mode": "fast"} for fractal in FRACTALS]
        hosts = [self.results.of_size(FILM_SIZE, **kind, backend=self.backends.host) for kind in kinds]
        gpus = [self.results.fastest_gpu(FILM_SIZE, **kind) for kind in kinds]
        pairs = [(gpu, host) for gpu, host in zip(gpus, hosts) if gpu and host]
        if len(pairs) < len(kinds):
            return None
        size = [pairs[0][1].number(f"/setting/{key}").html("plain") for key in ("width", "height")]
        return {"measured": [self._beside(*pair) for pair in pairs], "size": size, "host": self.backends.host}

    def _beside(self, gpu: Row, host: Row) -> dict[str, Any]:
        """Returns the times of a GPU's row and of the host's row for the same picture."""
        median = "/figures/kernel_seconds/median"
        return {
            "device": gpu.device_name,
            "backend": gpu.backend,
            "gpu": (1e3 * gpu.number(median)).html(),
            "host": host.bench.times(f"{host.at}/figures/kernel_seconds", 1e3),
            "times": (host.number(median) / gpu.number(median)).html(),
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
