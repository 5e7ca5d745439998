# SPDX-License-Identifier: Apache-2.0
"""The parts of the report: the results that it reads, and the figures, tables and sentences that it makes from them."""

from __future__ import annotations

import re
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import made  # noqa: E402
from mandelreport import flight  # noqa: E402
from mandelreport.figures import style, sweeps, timings  # noqa: E402
from mandelreport.backends import Backends  # noqa: E402
from mandelreport.bench import SAME_PEAK, Bench  # noqa: E402
from mandelreport.blocks import Numbers, ref  # noqa: E402
from mandelreport.pictures import Cache, Studio  # noqa: E402
from mandelreport.results import read_results  # noqa: E402
from mandelreport.sections import Material, gpu, parallel  # noqa: E402


class PartsTest(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_references_name_kind_and_number(self) -> None:
        numbers = Numbers()
        self.assertEqual([numbers.next("figure"), numbers.next("table", "times"), numbers.next("figure", "map-1")], [1, 1, 2])
        self.assertEqual(
            numbers.resolved(f"{ref('map-1')}, {ref('times')}"),
            '<a class="name" href="#figure-2">Figure 2</a>, <a class="name" href="#table-1">Table 1</a>',
        )
        self.assertEqual(numbers.resolved(ref("other")), "a figure or table without data")

    def test_threads_of_two_cores_are_a_sentence(self) -> None:
        def of(cores: int) -> dict[str, object]:
            data = made.sweep("threads", "threads", ["1", "2", "4", "8"])
            data["environment"]["cpu"]["cores_usable"] = cores
            results = made.read(self.folder / f"results{cores}", {"threads.json": data})
            return parallel.section(Material(results, Studio(self.folder, Cache(self.folder)), self.folder))

        self.assertEqual(of(2)["threads"], [])
        self.assertEqual([block.kind for block in of(4)["threads"]], ["figure"])
        plain = re.sub("<.*?>", "", of(2)["scaling"])
        self.assertTrue(plain.startswith("On as many threads as cores, a picture takes 0.5 [0.475, 0.525] to 0.5"), plain)
        self.assertIn("on twice as many, 0.333 [", plain)

    def test_double_over_float_has_every_ratio(self) -> None:
        data = made.bench()
        pairs = [(f"mandelbulb/double/{mode}/{backend}/0", mode, backend) for mode in ("exact", "fast") for backend in ("openmp", "vulkan")]
        data["questions"]["double_to_float"] = [
            {"numerator": name, "denominator": name.replace("double", "float"), "ratio": made.summary(1.25 + k)} for k, (name, *_) in enumerate(pairs)
        ]
        bench = Bench("made", Path("made"), data)
        figure = timings.double_to_float(bench, Backends.of(bench.environment["backends"], ["vulkan"]))
        for k, (_, mode, backend) in enumerate(pairs):
            self.assertIn(f"mandelbulb, {mode}, {backend}: {1.25 + k:.2f}", figure.alt)
        self.assertIsNone(timings.double_to_float(Bench("made", Path("made"), made.bench()), Backends()))

    def test_colours_follow_the_registration(self) -> None:
        registered = ["reference", "openmp", "openacc", "opencl", "vulkan"]
        colours = {"openmp": style.BLUE, "openacc": style.ORANGE, "opencl": style.GREEN, "vulkan": style.RED}

        def of(names: list[str], **roles: str) -> Backends:
            return Backends.of([{"name": name} | ({"role": roles[name]} if name in roles else {}) for name in names])

        def looks(backends: Backends) -> dict[str, str]:
            return {name: style.look(backends.number_of(name))["facecolor"] for name in backends.names}

        self.assertEqual(looks(of(registered)), colours | {"reference": style.SKY})
        # A new backend in the registry gets a new colour; the others keep theirs.
        more = of([*registered, "skeleton"])
        self.assertEqual(looks(more), colours | {"skeleton": style.SKY, "reference": style.PURPLE})
        self.assertEqual(more.order(["skeleton", "vulkan 1", "vulkan", "openmp"]), ["openmp", "vulkan", "vulkan 1", "skeleton"])
        # A backend that is not in the registry gets the next number.
        self.assertEqual(of(registered).number_of("skeleton"), len(registered))
        # Even if there are more series than colours, all series look different, as bars and as lines.
        many = [f"backend{number}" for number in range(40)]
        for kind in style.look, style.line:
            self.assertEqual(len({str(kind(of(many).number_of(name))) for name in many}), 40)
        # If a result states the roles of backends, the roles decide which backend is the reference and which is the
        # host. The names do not matter.
        renamed = of(["oracle", "cores"], oracle="reference", cores="host")
        self.assertEqual((renamed.names, renamed.reference, renamed.host), (("cores", "oracle"), "oracle", "cores"))

    def test_a_registered_backend_is_in_the_figures(self) -> None:
        data = made.with_scalar()
        data["environment"]["backends"] += [{**data["environment"]["backends"][0], "name": "skeleton", "role": ""}]
        data["rows"] += [made.row("mandelbulb", "float", "exact", "skeleton", 0.01)]
        bench = Bench("made", Path("made"), data)
        registered = bench.environment["backends"]
        figure = timings.over_scalar(bench, Backends.of(registered))
        self.assertIn("skeleton", str(figure.alt))
        self.assertNotEqual(figure, timings.over_scalar(bench, Backends.of(registered[::-1])))

    def test_machines_are_compared_at_one_size(self) -> None:
        def of(machine: str, runs: int, side: int) -> dict[str, object]:
            data = made.bench() | {"runs": runs}
            data["environment"]["cpu"]["platform"] = machine
            for row in data["rows"]:
                row["setting"] |= {"width": side, "height": side}
            return data

        files = {"a.json": of("one", 1, 540), "b.json": of("one", 3, 540), "c.json": of("one", 5, 1080), "d.json": of("two", 1, 540)}
        files["e.json"] = of("three", 9, 540)
        files["e.json"]["rows"] = [row for row in files["e.json"]["rows"] if row["backend"] == "openmp"]  # incomplete
        found = made.read(self.folder / "results", files)
        self.assertEqual([bench.name for bench in found.machines()], ["b.json", "d.json"])
        self.assertEqual(found.primary().name, "c.json")

    def test_machines_of_one_name_with_other_peaks_are_two(self) -> None:
        def of(factor: float, boot: str) -> dict[str, object]:
            data = made.bench()
            data["environment"]["os"]["boot"] = boot
            for peak in data["peaks"]:
                peak["operations_per_second"] *= factor
            return data

        def machines(*files: dict[str, object]) -> list[str]:
            found = made.read(self.folder / "results", {f"{n}.json": data for n, data in enumerate(files)})
            return [bench.machine.rpartition(", ")[2] for bench in found.benches]

        header = (ROOT / "bench" / "judge" / "platforms.h").read_text(encoding="utf-8")
        self.assertIn(f"same_peak = {SAME_PEAK};", header)
        self.assertEqual(machines(of(1, "a"), of(2, "b"), of(1.1, "c")), ["machine 1", "machine 2", "machine 1"])
        self.assertEqual(len(set(machines(of(1, "a"), of(2, "a"), of(1.1, "a")))), 1, "one boot is one machine")

    def test_a_machine_without_some_backends_is_compared(self) -> None:
        def of(machine: str, side: int, *more: str) -> dict[str, object]:
            data = made.bench()
            data["environment"]["cpu"]["platform"] = machine
            rows = data["rows"]
            data["rows"] = [row | {"backend": backend, "application": backend} for backend in ("openmp", "opencl", "vulkan", *more) for row in rows[:4]]
            for row in data["rows"]:
                row["setting"] = row["setting"] | {"width": side, "height": side}
            return data

        files = {"a.json": of("one", 540, "kokkos", "stdpar"), "b.json": of("one", 1080), "c.json": of("two", 1080, "openacc")}
        found = made.read(self.folder / "results", files)
        self.assertEqual([bench.name for bench in found.machines()], ["b.json", "c.json"])
        self.assertEqual(found.primary().name, "a.json")

    def test_a_gpu_that_was_measured_stands_beside_its_prediction(self) -> None:
        line = "mandelbulb float fast cuda 79 247 63% 49% 0.4 0.3 0.4 0.7\n"
        files: dict[str, object] = {"h.txt": f"H100 on paper, x\n{line}", "k.txt": f"K40 on paper, x\n{line}"}
        data = made.bench()
        row = next(r for r in data["rows"] if (r["fractal"], r["precision"], r["mode"]) == ("mandelbulb", "float", "fast"))
        row |= {"is_gpu": True, "device_name": "NVIDIA H200", "backend": "cuda", "application": "cuda"}
        row["setting"] |= {"width": 1920, "height": 1080}
        row["figures"]["kernel_seconds"] |= {"median": 0.0008, "interval": None}
        files["bench.json"] = data
        results = made.read(self.folder / "results", files)
        found = gpu.section(SimpleNamespace(results=results, backends=results.backends()))["tables"]
        self.assertEqual([table.caption.partition(":")[0] for table in found], ["K40", "H100"])
        self.assertNotIn("measured ms", found[0].headers)
        self.assertEqual(found[1].rows[0][11:14], ["0.7", "0.8", "2.00"])

    def test_texts_are_known_by_their_first_line(self) -> None:
        files = {"a.txt": "flight study: x\n", "b.txt": "flight studies\n", "c.txt": "loop mix: y\n"}
        files |= {"d.txt": "K40 on paper, x\n", "e.txt": "ptxas 11.8, y\n"}
        found = made.read(self.folder / "results", files)
        self.assertEqual(found.flight_studies, ["flight study: x\n"])
        self.assertEqual(found.loop_mix, "loop mix: y\n")
        self.assertEqual(found.k40, "K40 on paper, x\n\nptxas 11.8, y\n")

    def test_negative_levels_have_an_axis(self) -> None:
        study = made.sweep("detail", "detail", ["-2", "-3", "-4"])
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # matplotlib warns if a logarithmic axis loses points
            self.assertIsNotNone(sweeps.sweep(Bench("made", Path("made"), study), "D", "ms", "caption"))

    def test_film_of_a_log(self) -> None:
        log = (
            "drawing with openmp (no GPU here)\nmandelbox, seed 3, 600 frames (20.0 s); ! is a promise\n"
            "film: 10 of 10 segments rendered in 150.0 s by 2 processes; video.mp4 is complete\n"
        )
        film = flight.film_of_log("film.txt", log)
        self.assertEqual((film.fractal, film.frames, film.processes, film.per_frame), ("mandelbox", 600, 2, 0.25))
        self.assertEqual(film.device, "openmp (no GPU here)")
        # The log of a film that was resumed has no time for the whole film.
        self.assertIsNone(flight.film_of_log("film.txt", log.replace("10 of 10", "4 of 10")))
        self.assertIsNone(flight.film_of_log("film.txt", "film: nothing\n"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
