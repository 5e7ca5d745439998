# SPDX-License-Identifier: Apache-2.0
"""Single numbers for the documents. NUMBERS has the name of each function in a place of a document (figures.py). The
function takes the results and the arguments that the place gives, and returns the text for the place."""
import re

from mandelreport.bench import SAME_WORK, SCALAR
from mandelreport.errors import InputError
from mandelreport.text import digits, with_interval

FRACTALS = {"bulb": "mandelbulb", "box": "mandelbox"}


def rows_of(results, study):
    """Returns all timed configurations of a study."""
    return [row for row in results.bench(study).all_rows if row.timed]


def row_of(results, study, fractal, precision, mode, *more):
    """Returns a timed configuration. `fractal`: bulb or box; `more`: a backend (default openmp) and a sweep value, in
    any order, both optional."""
    value = next((word for word in more if "=" in word), "")
    backend = next((word for word in more if "=" not in word), "openmp")
    key = (FRACTALS.get(fractal, fractal), precision, mode, backend, value, 0)
    found = [row for row in rows_of(results, study) if (*row.kind, row.backend, row.sweep_value, row.device) == key]
    if not found:
        raise InputError(f"{study}.json has no timed row {' '.join(filter(None, key[:-1]))}")
    return found[0]


def ratio_of(results, study, question, row):
    """Returns the ratio of kernel times that answers a question for a configuration, as (median, interval or None)."""
    found = results.bench(study).ratio(question, row.name)
    if found is None:
        raise InputError(f"{study}.json says nothing of {row.name} in {question}")
    return found["ratio"]["median"], found["ratio"]["interval"]


def bracketed(value, interval, form="{:.2f}".format):
    """Formats a value with its interval, such as "1.23 [1.20, 1.26]", or only the value if there is no interval."""
    return with_interval(value, interval, form, ", ")


def ms(results, study, *row):
    """Median kernel time of a configuration, in milliseconds."""
    return f"{1e3 * row_of(results, study, *row).kernel.median:.1f}"


def worth(results, technique, fractal, precision):
    """Kernel time of a fast picture without a technique, divided by the time with all techniques, with the interval."""
    row = row_of(results, "ablation", fractal, precision, "fast", f"without={technique}")
    return bracketed(*ratio_of(results, "ablation", "to_first_value", row))


def own_lines(results, backend):
    """Lines of code in a backend's own folder and, if it shares core/job, those that it uses of core/job."""
    model = next(model for model in results.json("lines_of_code")["models"] if model["backend"] == backend)
    return f"{model['lines']} + {model['lines_of_job']}" if model["lines_of_job"] else str(model["lines"])


def cost(results, technique, fractal, precision):
    """Percentage that a technique adds to the kernel time of a fast picture."""
    row = row_of(results, "ablation", fractal, precision, "fast", f"without={technique}")
    without, interval = ratio_of(results, "ablation", "to_first_value", row)
    low, high = interval or (without, without)
    return bracketed(100 / without - 100, [100 / high - 100, 100 / low - 100] if interval else None, "{:.0f}".format)


def ladder(results, fractal, rung=None):
    """Gain of a rung of the ladder over the rung before it or, without `rung`, of the last rung over the first, with
    the interval."""
    rows = [row for row in rows_of(results, "ladder") if row.fractal == FRACTALS[fractal]]
    row = rows[-1] if rung is None else next(row for row in rows if row.sweep_value == f"rung={rung}")
    ratio, interval = ratio_of(results, "ladder", "to_first_value" if rung is None else "to_previous_value", row)
    return bracketed(1 / ratio, interval and [1 / end for end in reversed(interval)], digits)


def over_scalar(results, study, fractal, precision, mode):
    """Speed-up of openmp's fastest packs over the scalar kernel on the same threads, computed from wall times, with the
    interval."""
    rows = [row for row in rows_of(results, study) if row.backend == "openmp" and row.figures["over_scalar"] is not None and
            row.kind == (FRACTALS[fractal], precision, mode)]
    if not rows:
        raise InputError(f"{study}.json has no row {fractal} {precision} {mode} beside the scalar text")
    figures = min(rows, key=lambda row: row.kernel.median).figures
    return bracketed(figures["over_scalar"], figures["over_scalar_interval"], "{:.1f}".format)


def model_cost(results, study, *backends):
    """Range of the speeds per thread of backends that run the scalar kernel, relative to openmp's scalar kernel, in
    configurations with the same work."""
    speeds = []
    for row in rows_of(results, study):
        if row.backend in (backends or ("stdpar", "kokkos", "openacc", "omptarget")):
            scalar = row_of(results, study, *row.kind, SCALAR)
            if row.operations and scalar.operations and abs(row.operations / scalar.operations - 1) <= SAME_WORK:
                speeds.append(row.figures["over_scalar"] * scalar.threads / row.threads)
    if not speeds:
        raise InputError(f"{study}.json has no rows of {' '.join(backends)}")
    return range_of(speeds, 2)


def speed_up(results, file, mode, backend):
    """Range of the speed-ups of a duel's second program over the first, in one mode and with one backend."""
    duel = results.json(file)
    chosen = {row["name"]: row["same_picture"] for row in duel["rows"] if row["name"].split("/")[2:4] == [mode, backend]}
    if mode == "exact" and not all(chosen.values()):
        raise InputError(f"{file}.json: the two programs draw different exact pictures with {backend}")
    ratios = [1 / one["ratio"] for one in duel["verdicts"] if one["name"] in chosen]
    if not ratios:
        raise InputError(f"{file}.json has no pictures of {backend} in {mode} mode")
    return range_of(ratios, 2)


def share(results, study, *row):
    """Share of the measured multiply-add peak that a configuration reaches, in percent."""
    return f"{100 * row_of(results, study, *row).figures['share_of_peak']:.0f}"


def range_of(values, places=1):
    low, high = (f"{value:.{places}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def over_openmp(results, study, backend):
    """Range of a backend's kernel times divided by openmp's in a study."""
    found = [row for row in rows_of(results, study) if row.backend == backend]
    if not found:
        raise InputError(f"{study}.json has no rows of {backend}")
    return range_of([ratio_of(results, study, "others_to_host", row)[0] for row in found])


def over_cuda(results, device, step, backend):
    """Range of a backend's kernel times of fast pictures on a GPU divided by cuda's. `step`: the step of gpu_check that
    timed the backend."""
    rows = [row for row in rows_of(results, f"{device}/t-{step}") if row.mode == "fast"]
    ratios = [row.kernel.median / row_of(results, f"{device}/t-cuda", *row.kind, "cuda").kernel.median for row in rows]
    if not rows or any(row.backend != backend for row in rows):
        raise InputError(f"{device}/t-{step}.json has rows of other backends than {backend}, or none")
    return range_of(ratios)


def work_over_openmp(results, study, backend):
    """Range of a backend's counted operations divided by openmp's in a study."""
    found = [row for row in rows_of(results, study) if row.backend == backend and row.operations]
    if not found:
        raise InputError(f"{study}.json has no rows of {backend}")
    hosts = [row_of(results, study, *row.kind) for row in found]
    return range_of([row.operations / host.operations for row, host in zip(found, hosts)])


def one_register(results):
    """Range of openmp's kernel times with packs of one register, divided by those with its widest packs."""
    ratios = []
    for fractal in FRACTALS:
        for precision, width in (("float", 16), ("double", 8)):
            rows = [row for row in rows_of(results, "simd-widths") if (row.backend, *row.kind) ==
                    ("openmp", FRACTALS[fractal], precision, "exact")]
            widest = max(rows, key=lambda row: row.setting["simd_width"])
            ratios.append(row_of(results, "simd-widths", fractal, precision, "exact", f"simd-width={width}").kernel.median / widest.kernel.median)
    return range_of(ratios)


def backends_with_same_bits(results, study):
    """Number of backends that give the bits of the scalar kernel in all their exact configurations."""
    exact = [row for row in results.json(study)["rows"] if row["mode"] == "exact"]
    same = {row["backend"] for row in exact if row["verification"]["level"] == "same bits"}
    return str(len(same - {row["backend"] for row in exact if not row["verification"]["passed"]}))


def rows_verified(results, study):
    """Number of configurations whose pictures were verified before they were timed."""
    rows = rows_of(results, study)
    if not all(row.verification["passed"] for row in rows):
        raise InputError(f"{study}.json has a timed row whose picture is wrong")
    return str(sum(not row.verification["is_expected"] for row in rows))


def random_off(results, study, fractal, precision):
    """Range, over the sets of random scenes, of the percentage of pixels that differ visibly from the canonical
    picture."""
    sums = next(s for s in results.json(study)["sums"] if (s["fractal"], s["precision"]) == (fractal, precision))
    return range_of([s["off_percent"] for s in sums["sets"].values()], 2)


def film(results, key):
    """An integer from the film's summary."""
    return f"{results.json('film')[key]:.0f}"


NUMBERS = {
    "backends-with-same-bits": backends_with_same_bits,
    "cost": cost,
    "film": film,
    "ladder": ladder,
    "model-cost": model_cost,
    "ms": ms,
    "one-register": one_register,
    "over-cuda": over_cuda,
    "over-openmp": over_openmp,
    "over-scalar": over_scalar,
    "own-lines": own_lines,
    "rows-verified": rows_verified,
    "share": share,
    "speed-up": speed_up,
    "work-over-openmp": work_over_openmp,
    "worth": worth,
}
