# SPDX-License-Identifier: Apache-2.0
"""Tables for the documents. TABLES has the name of each function in a place of a document (figures.py). The function
takes the results and the arguments that the place gives, and returns the text for the place."""
import functools
import re
import textwrap

from figure_numbers import FRACTALS, bracketed, random_off, ratio_of, row_of, rows_of
from mandelreport.errors import InputError
from mandelreport.text import digits

four = functools.partial(digits, count=4)  # significant digits

CONFIGURATIONS = [(f, p, m) for f in FRACTALS for m in ("exact", "fast") for p in ("double", "float")]
TECHNIQUES = {  # sweep values of the ablation study
    "hull": "hull", "relaxation": "over-relaxation", "cones": "cones", "neighbours": "neighbours",
    "all-four": "all four together",
    "trial": "trials", "tail": "tails", "refinement": "the root refined", "gradient": "normals from the gradient",
}
SIDES = (270, 540, 1080, 2160)  # pixels, of the resolution study
NAME_WIDTH = 46  # characters of an audit item's name in tools/flight_study.py's table


def table(head, rows):
    """Formats a Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def measured(results, *studies):
    """Machine, date and revision of studies, one sentence for those that agree."""
    found = {}
    for study in studies:
        e = results.json(study)["environment"]
        dirty = " with changes that no commit has" if e["git"]["dirty"] else ""
        where = (f"Measured on {e['cpu'].get('platform', e['cpu']['model'])}, {e['cpu']['cores_usable']} threads, on "
                 f"{e['date'][:10]}, at revision {e['git']['revision'][:7]}{dirty}:")
        found.setdefault(where, []).append(f"`{study}.json`")
    return "\n".join(textwrap.fill(f"{where} {', '.join(files)}.", 120) for where, files in found.items())


def lines_of_code(results):
    """Lines of code that each backend needs, from tools/lines_of_code.py."""
    rows = [[f"`{m['backend']}`", str(m["lines"]), str(m["lines_of_job"]), str(m["lines_of_kernel"])]
            for m in results.json("lines_of_code")["models"]]
    return table(["backend", "lines of its own", "of core/job", "of core/kernel"], rows)


def beside_openmp(results, study, key, backend):
    """Kernel time of a backend divided by openmp's; "-" if the backend was not timed."""
    try:
        return bracketed(*ratio_of(results, study, "others_to_host", row_of(results, study, *key, backend)))
    except InputError:
        return "-"


def targets(results, study):
    """Table of openmp's times and speed-ups, compared with the reference, the scalar kernel and other backends."""
    head = ["fractal", "precision", "mode", "kernel ms", "over serial", "over scalar", "work over scalar's", "share of peak",
            "opencl / openmp", "vulkan / openmp"]
    rows = []
    for key in CONFIGURATIONS:
        fractal, precision, mode = key
        row = row_of(results, study, *key)
        rows.append([FRACTALS[fractal], precision, mode, f"{1e3 * row.kernel.median:.1f}", quotient(row, "speed_up"),
                     quotient(row, "over_scalar"), work_cell(results, study, row), f"{100 * row.figures['share_of_peak']:.0f} %",
                     *(beside_openmp(results, study, key, backend) for backend in ("opencl", "vulkan"))])
    return table(head, rows)


def instruction_sets(results, *studies):
    """Table of openmp's speed-ups with several instruction sets, each from a study of its own."""
    names = [row_of(results, study, "bulb", "float", "fast").instruction_set for study in studies]
    # AVX3 is Highway's name of AVX-512.
    head = ["fractal", "precision", "mode", *("AVX-512" if name == "AVX3" else name for name in names)]
    rows = []
    for fractal, precision, mode in CONFIGURATIONS:
        found = [row_of(results, study, fractal, precision, mode) for study in studies]
        rows.append([FRACTALS[fractal], precision, mode, *(quotient(row, "speed_up") for row in found)])
    return table(head, rows)


def ablation(results):
    """Gain from each technique of fast mode: the kernel time without it divided by the time with all techniques."""
    columns = [(fractal, precision) for fractal in FRACTALS for precision in ("double", "float")]
    rows = []
    for technique, name in TECHNIQUES.items():
        cells = []
        for fractal, precision in columns:
            if technique == "gradient" and precision == "float":
                cells.append("-")
                continue
            row = row_of(results, "ablation", fractal, precision, "fast", f"without={technique}")
            cells.append(bracketed(*ratio_of(results, "ablation", "to_first_value", row)) +
                         (f" ({100 * row.visibly_off:.1f} % off)" if technique == "refinement" else ""))
        rows.append([name, *cells])
    bounds = [row_of(results, "ablation", *column, "fast", "without=none") for column in columns]
    rows.append(["least possible time of the counted work at the measured peak, and measured time, in ms",
                 *(f"{1e3 * row.figures['bound_seconds']:.1f}, {1e3 * row.kernel.median:.1f}" for row in bounds)])
    return table(["without", *(f"{fractal}, {precision}" for fractal, precision in columns)], rows)


def growth(results):
    """Table of the factors by which fast mode's times grow with four times the pixels."""
    head = ["fractal, precision", *(f"{a} to {b}" for a, b in zip(SIDES, SIDES[1:])), "a step, on average over the sweep"]
    rows = []
    for fractal in FRACTALS:
        for precision in ("double", "float"):
            later = [row_of(results, "resolution_fast", fractal, precision, "fast", f"size={s}x{s}") for s in SIDES[1:]]
            steps = [ratio_of(results, "resolution_fast", "to_previous_value", row) for row in later]
            sweep, interval = ratio_of(results, "resolution_fast", "to_first_value", later[-1])
            root = 1 / len(later)
            mean = (sweep ** root, [end ** root for end in interval] if interval else None)
            rows.append([f"{FRACTALS[fractal]}, {precision}", *(bracketed(*step) for step in [*steps, mean])])
    return table(head, rows)


def closeups(results):
    """Table of the times of close-ups that show only surface, compared with the official scenes."""
    columns = [("closeup", "float", "exact"), ("closeup_fast", "double", "fast"), ("closeup_fast", "float", "fast")]
    rows = []
    for fractal in FRACTALS:
        cells = []
        for study, precision, mode in columns:
            pair = [row_of(results, study, fractal, precision, mode, f"scene={scene}") for scene in ("close", "official")]
            close, official = (bracketed(1e3 * row.kernel.median, interval_ms(row), "{:.1f}".format) for row in pair)
            cells.append(f"{close} ({official})")
        close = row_of(results, "closeup_fast", fractal, "float", "fast", "scene=close")
        rows.append([FRACTALS[fractal], *cells, f"{100 * close.visibly_off:.1f} %"])
    head = ["kernel ms (the official scene)", *(f"{mode}, {precision}" for _, precision, mode in columns), "fast float is off"]
    return table(head, rows)


def random(results, study):
    """Table of the differences between fast pictures of random scenes and the canonical pictures."""
    rows = []
    for sums in results.json(study)["sums"]:
        key = (sums["fractal"], sums["precision"])
        wrong = [s["hit_or_miss_percent"] for s in sums["sets"].values()]
        every = sums["all"]
        rows.append([f"{FRACTALS[key[0]]}, {key[1]}", f"{random_off(results, study, *key)} %",
                     f"{min(wrong):.3f} to {max(wrong):.3f} %", f"{every['scenes_far_off']} of {every['scenes']}",
                     str(every["of_these_short_of_digits"]), f"{every['worst_off_percent']:.1f} %"])
    return table(["", "pixels off, by set", "hit or miss, by set", "scenes over 2 %", "of these short of digits", "worst"], rows)


def quotient(row, key):
    """Formats a speed-up with its interval. Returns "-" if it is unknown, and "1" for a baseline's speed-up over
    itself."""
    value, interval = row.figures[key], row.figures[key + "_interval"]
    return "-" if value is None else "1" if value == 1 else bracketed(value, interval, four)


def interval_ms(row):
    """Returns the interval of the kernel time in milliseconds, or None if there is none."""
    return row.kernel.interval and [1e3 * end for end in row.kernel.interval]


def work_cell(results, name, row):
    """A configuration's counted operations divided by the scalar kernel's; "-" if one of them is unknown."""
    work = results.bench(name).work_over_scalar(row, "openmp")
    return "-" if work is None else four(work)


def row_cells(results, name, row):
    interval = interval_ms(row)
    interval = "[" + ", ".join(map(four, interval)) + "]" if interval else "-"
    share = row.figures["share_of_peak"]
    return [*row.kind, row.application, row.verification["text"],
            four(1e3 * row.kernel.median), interval, f"{100 * share:.0f} %" if share else "-", quotient(row, "speed_up"),
            quotient(row, "over_scalar"), work_cell(results, name, row)]


ROW_HEAD = ["fractal", "precision", "mode", "backend", "verification", "kernel ms", "95 % interval", "share of peak", "over serial",
            "over scalar", "work over scalar's"]


def study(results, name):
    """Table of all timed configurations of a study."""
    return table(ROW_HEAD, [row_cells(results, name, row) for row in rows_of(results, name)])


def four_rows(results, name):
    """Table of two of openmp's configurations for each fractal: exact in double, and fast in float."""
    chosen = [(fractal, *kind) for fractal in FRACTALS for kind in (("double", "exact"), ("float", "fast"))]
    return table(ROW_HEAD, [row_cells(results, name, row_of(results, name, *key)) for key in chosen])


def aloud(results, name):
    """The last row of four_rows(), without its last two columns, and sentences with its values."""
    row = row_of(results, name, "box", "float", "fast")
    low, high = interval_ms(row)
    width, height = row.size
    serial = bracketed(row.figures["speed_up"], row.figures["speed_up_interval"], "{:.0f}".format)
    return "\n".join([
        table(ROW_HEAD[:-2], [row_cells(results, name, row)[:-2]]),
        "",
        f"In words: in fast mode and float `openmp` draws the Mandelbox at {width} x {height} in",
        f"{1e3 * row.kernel.median:.1f} ms, the median of {row.kernel.count} pictures in {results.bench(name).data['runs']} runs. The true median "
        f"lies between {low:.1f} and {high:.1f} ms with 95 %",
        f"confidence. {100 * row.visibly_off:.1f} % of the pixels differ visibly from the reference's canonical picture. The counted operations",
        f"take {100 * row.figures['share_of_peak']:.0f} % of the processor's measured multiply-add peak. The serial reference, in double and exact",
        f"mode, takes {serial} times as long.",
    ])


def missed(results):
    """Table of the audit items whose thresholds some seeds do not keep, measured by make flight-study."""
    rows, fractal = [], ""
    for line in results.text("flight_seeds.txt").splitlines():
        kept = re.search(r"(\d+)/(\d+)$", line)
        if kept and kept[1] != kept[2]:
            sign, bar, *values = line[NAME_WIDTH:kept.start()].split()
            worst = (max if sign == "<=" else min)(values, key=float)
            kind = "promise" if line[0] == "!" else "quality"
            rows.append([fractal, line[2:NAME_WIDTH].strip(), kind, f"{sign} {bar}", worst, f"{kept[1]} of {kept[2]}"])
        elif " seeds, " in line and line.split(":")[0] in FRACTALS.values():
            fractal = line.split(":")[0]
    if not rows:
        return "Every seed keeps every threshold."
    return table(["fractal", "item", "promise or quality", "threshold", "worst value", "seeds that keep it"], rows)


TABLES = {
    "lines-of-code": lines_of_code,
    "ablation": ablation,
    "aloud": aloud,
    "closeups": closeups,
    "four-rows": four_rows,
    "growth": growth,
    "instruction-sets": instruction_sets,
    "measured": measured,
    "missed": missed,
    "random": random,
    "study": study,
    "targets": targets,
}
