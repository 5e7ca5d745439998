# SPDX-License-Identifier: Apache-2.0
"""The parts of the report: the results that it reads, and the figures, tables and sentences that it makes from them."""

from __future__ import annotations

import os
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "report"), str(Path(__file__).parent)]

import made  # noqa: E402
import made_programs  # noqa: E402
from mandelreport import charts  # noqa: E402
from mandelreport.bench import Backends, Bench  # noqa: E402
from mandelreport.errors import write_whole  # noqa: E402
from mandelreport.pictures import Cache, Key, Studio  # noqa: E402
from mandelreport.sections import Material, speed, sweeps, tables, why  # noqa: E402
from mandelreport.text import digits  # noqa: E402


class PartsTest(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_files_are_written_as_the_programs_write_them(self) -> None:
        new, kept, link = self.folder / "new", self.folder / "kept", self.folder / "link"
        kept.write_bytes(b"old")
        kept.chmod(0o640)
        link.symlink_to("kept")
        write_whole(link, b"text")
        self.assertEqual((link.is_symlink(), kept.read_bytes(), kept.stat().st_mode & 0o777), (True, b"text", 0o640))
        mask = os.umask(0o027)
        write_whole(new, b"text")
        os.umask(mask)
        self.assertEqual(new.stat().st_mode & 0o777, 0o640)
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        write_whole(pipe, b"through")
        self.assertEqual((os.read(reader, 99), pipe.is_fifo()), (b"through", True))
        os.close(reader)
        # A name that anybody can foretell is not used.
        (self.folder / "new.part").symlink_to("kept")
        write_whole(new, b"again")
        self.assertEqual((kept.read_bytes(), new.read_bytes()), (b"text", b"again"))
        with self.assertRaisesRegex(OSError, "^/dev/full: No space left on device$"):
            write_whole(Path("/dev/full"), b"text")
        self.assertEqual(list(self.folder.glob(".*")), [])

    def test_blank_lines_and_comments_are_not_code(self) -> None:
        for text, lines in (
            ("\n  // b\nint c; // d\n", 1),
            ("/* a\nint b;\n*/ int c;\n", 1),
            ('f("// no comment");\n"/*" + a;\nb;', 3),
            ('"\\"/*";\na;\n', 2),
            ("/* no end\nb;", 0),
        ):
            self.assertEqual(tables.code_lines(text), lines, text)

    def test_pictures_are_of_the_devices_that_are_here(self) -> None:
        programs = made_programs.programs(self.folder / "bin")
        key = Key("mandelbulb", "double", "fast", "opencl")

        def drawn() -> tuple[bool, dict[Key, str]]:
            studio = Studio(programs, Cache(self.folder / "cache"))
            return studio.picture(key) is not None, studio.reasons

        self.assertEqual(drawn(), (False, {key: "render: backend opencl: not here"}))
        with mock.patch.dict(os.environ, MADE_DRIVER="2"):
            self.assertEqual(drawn(), (True, {}))
            # A picture whose stats are missing, as after a kill, is drawn again.
            next((self.folder / "cache").glob("*.png.stats")).unlink()
            self.assertEqual(drawn(), (True, {}))

    def test_threads_of_two_cores_have_no_figure(self) -> None:
        def of(cores: int) -> dict[str, object]:
            data = made.stored("threads.json")
            data["environment"]["cpu"]["cores_usable"] = cores
            results = made.read(self.folder / f"results{cores}", {"threads.json": data})
            return sweeps.parallel(Material(results, Studio(self.folder, Cache(self.folder)), self.folder))

        self.assertEqual(of(2)["threads"], [])
        self.assertEqual([block.kind for block in of(4)["threads"]], ["figure"])

    def test_double_over_float_has_every_ratio(self) -> None:
        data = made.bench()
        bench = Bench("made", Path("made"), data)
        backends = Backends.of(bench.environment["backends"])
        figure = why.double_to_float(bench, backends)
        for ratio in bench.ratios("double_to_float"):
            row = bench.named(ratio.numerator)
            self.assertIn(f"{row.fractal}, {row.mode}, {row.label}: {digits(ratio.times.median)}", figure.alt)
        data["questions"]["double_to_float"] = []
        self.assertIsNone(why.double_to_float(bench, backends))

    def test_colours_follow_the_registration(self) -> None:
        registered = ["reference", "openmp", "openacc", "opencl", "vulkan"]
        colours = {"openmp": charts.BLUE, "openacc": charts.ORANGE, "opencl": charts.GREEN, "vulkan": charts.RED}

        def of(names: list[str], **roles: str) -> Backends:
            return Backends.of([{"name": name} | ({"role": roles[name]} if name in roles else {}) for name in names])

        def looks(backends: Backends) -> dict[str, str]:
            return {name: charts.line(backends.number_of(name))["color"] for name in backends.names}

        self.assertEqual(looks(of(registered)), colours | {"reference": charts.SKY})
        # A new backend in the registry gets a new colour; the others keep theirs.
        more = of([*registered, "skeleton"])
        self.assertEqual(looks(more), colours | {"skeleton": charts.SKY, "reference": charts.PURPLE})
        self.assertEqual(more.order(["skeleton", "vulkan 1", "vulkan", "openmp"]), ["openmp", "vulkan", "vulkan 1", "skeleton"])
        # A backend that is not in the registry gets the next number.
        self.assertEqual(of(registered).number_of("skeleton"), len(registered))
        # Even if there are more series than colours, all series look different.
        self.assertEqual(len({str(charts.line(number)) for number in range(40)}), 40)
        # If a result states the roles of backends, the roles decide which backend is the reference and which is the
        # host. The names do not matter.
        renamed = of(["oracle", "cores"], oracle="reference", cores="host")
        self.assertEqual((renamed.names, renamed.reference, renamed.host), (("cores", "oracle"), "oracle", "cores"))

    def test_a_registered_backend_is_in_the_figures(self) -> None:
        data = made.bench()
        data["environment"]["backends"] += [{**data["environment"]["backends"][0], "name": "skeleton", "role": ""}]
        data["rows"] += [row | {"backend": "skeleton", "application": "skeleton"} for row in data["rows"][-1:]]
        bench = Bench("made", Path("made"), data)
        registered = bench.environment["backends"]
        figure = speed.over_scalar(bench, Backends.of(registered))
        self.assertIn("skeleton", str(figure.alt))
        self.assertNotEqual(figure, speed.over_scalar(bench, Backends.of(registered[::-1])))

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

    def test_negative_levels_have_an_axis(self) -> None:
        study = made.stored("detail.json")
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # matplotlib warns if a logarithmic axis loses points
            self.assertIsNotNone(sweeps.figure_of(Bench("made", Path("made"), study), "D", "ms", "caption"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
