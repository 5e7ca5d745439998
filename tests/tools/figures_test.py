#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""figures_test.py: tools/figures.py fills the marked places of documents from result files, and detects places whose
content is out of date."""
import copy
import json
import pathlib
import statistics
import unittest

from tool import ToolTest

ENVIRONMENT = {"date": "2026-01-02T03:04:05Z", "git": {"revision": "0123456789abcdef", "dirty": False},
               "cpu": {"model": "A Processor", "cores_usable": 2}}


def row(value, seconds):
    figures = {"kernel_seconds": {"median": seconds, "count": 9, "interval": [seconds, 2 * seconds]},
               "wall_seconds": {"median": seconds}, "share_of_peak": 0.25, "speed_up": 12.5, "speed_up_interval": None,
               "over_scalar": 4.0, "over_scalar_interval": [3.0, 5.0]}
    return {"name": value, "fractal": "mandelbulb", "precision": "float", "mode": "fast", "backend": "openmp", "application": "openmp",
            "device": 0, "sweep_value": value,
            "verification": {"level": "perceptual", "passed": True, "is_expected": False, "text": "0.500 % off", "pixels": 200,
                      "visibly_differing": 1}, "figures": figures}


RATIO = {"numerator": "without=hull", "denominator": "without=none", "ratio": {"count": 9, "median": 1.5, "interval": [1.25, 1.75]}}
ABLATION = {"environment": ENVIRONMENT, "rows": [row("without=none", 0.02), row("without=hull", 0.03)],
            "questions": {"to_first_value": [RATIO]}}
WORTH = "It takes <!-- figures: worth hull bulb float -->1.50 [1.25, 1.75]<!-- end --> times as long.\n"
TABLE = """<!-- figures: study ablation -->
| fractal | precision | mode | backend | verification | kernel ms | 95 % interval | share of peak | over serial | over scalar | work over scalar's |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
| mandelbulb | float | fast | openmp | 0.500 % off | 20.00 | [20.00, 40.00] | 25 % | 12.50 | 4.000 [3.000, 5.000] | - |
| mandelbulb | float | fast | openmp | 0.500 % off | 30.00 | [30.00, 60.00] | 25 % | 12.50 | 4.000 [3.000, 5.000] | - |
<!-- end -->
"""


class FiguresTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.results(ABLATION)

    def results(self, data):
        self.write("ablation.json", json.dumps(data))

    def figures(self, text, *options):
        """Runs tools/figures.py on a document. Returns the exit code, stderr and the changed document."""
        self.write("page.md", text)
        done = self.run_tool("figures.py", "--results", ".", *options, "page.md")
        return done.returncode, done.stderr, self.read("page.md")

    def test_a_number_is_filled_in(self):
        empty = WORTH.replace("1.50", "")
        self.assertEqual(self.figures(empty), (0, "", WORTH))

    def test_a_table_is_filled_in(self):
        self.assertEqual(self.figures("<!-- figures: study ablation --><!-- end -->\n"), (0, "", TABLE))

    def test_less_work_than_the_scalar_text_s_is_said_and_a_baseline_has_no_interval(self):
        data = copy.deepcopy(ABLATION)
        for row_of, value, operations in zip(data["rows"], ("", "simd-width=1"), (30e6, 50e6)):
            row_of |= {"sweep_value": value, "operations": operations}
        data["rows"][0]["figures"] |= {"speed_up": 1.0, "speed_up_interval": [0.7, 1.4]}
        self.results(data)
        _, _, text = self.figures("<!-- figures: study ablation --><!-- end -->\n")
        self.assertIn("| 25 % | 1 | 4.000 [3.000, 5.000] | 0.6 |", text)
        self.assertIn("| 1.000 |", text.splitlines()[4])

    def test_a_model_s_cost_is_compared_thread_for_thread(self):
        data = copy.deepcopy(ABLATION)
        model, scalar = data["rows"]
        model |= {"backend": "kokkos", "application": "kokkos", "sweep_value": "", "threads": 1, "operations": 1e9}
        scalar |= {"sweep_value": "simd-width=1", "threads": 2, "operations": 1.001e9}
        model["figures"]["over_scalar"] = 0.49
        # A configuration with other work is left out.
        other = copy.deepcopy(model) | {"name": "other", "operations": 1.5e9}
        other["figures"]["over_scalar"] = 0.1
        data["rows"].append(other)
        self.results(data)
        place = "It runs at <!-- figures: model-cost ablation -->0.98<!-- end --> times the speed.\n"
        self.assertEqual(self.figures(place, "--check"), (0, "", place))

    def test_a_gpu_s_backend_is_compared_with_cuda_in_fast_mode(self):
        for step, backend, seconds in (("cuda", "cuda", (0.002, 0.004)), ("cl", "opencl", (0.003, 0.016)), ("vk", "cuda", (1, 1))):
            data = copy.deepcopy(ABLATION)
            for row, mode, kernel in zip(data["rows"], ("fast", "exact"), seconds):
                row |= {"backend": backend, "application": backend, "sweep_value": "", "mode": mode}
                row["figures"]["kernel_seconds"]["median"] = kernel
            self.write(f"gpu/t-{step}.json", json.dumps(data))
        place = "It takes <!-- figures: over-cuda gpu cl opencl -->1.5<!-- end --> times as long.\n"
        self.assertEqual(self.figures(place, "--check"), (0, "", place))
        code, said, _ = self.figures(place.replace("cl opencl", "vk vulkan"), "--check")
        self.assertEqual(code, 2)
        self.assertIn("gpu/t-vk.json has rows of other backends than vulkan", said)

    def test_a_duel_s_speed_ups_are_those_of_a_mode_and_a_backend(self):
        ratios = {"mandelbulb/double/exact/stdpar/0": 0.8, "mandelbox/float/exact/stdpar/0": 1.25,
                  "mandelbox/float/fast/stdpar/0": 0.5, "mandelbox/float/exact/kokkos/0": 0.1}
        duel = {"verdicts": [{"name": name, "ratio": ratio} for name, ratio in ratios.items()],
                "rows": [{"name": name, "same_picture": "/exact/" in name} for name in ratios]}
        self.write("native.json", json.dumps(duel))
        place = "It is <!-- figures: speed-up native exact stdpar -->0.80 to 1.25<!-- end --> times as fast, with kokkos " \
            "<!-- figures: speed-up native exact kokkos -->10.00<!-- end -->.\n"
        self.assertEqual(self.figures(place, "--check"), (0, "", place))
        # Exact pictures must have the same bits.
        duel["rows"][0]["same_picture"] = False
        self.write("native.json", json.dumps(duel))
        code, said, _ = self.figures(place, "--check")
        self.assertNotEqual(code, 0)
        self.assertIn("different exact pictures with stdpar", said)

    def test_readme_s_sentences_are_those_of_the_samples(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        data = json.loads((root / "results/bench.json").read_text())
        rows = {row["name"]: row for row in data["rows"]}
        fast, serial = rows["mandelbox/float/fast/openmp/0"], rows["mandelbox/double/exact/reference/0"]
        kernel = [sample["kernel"] for sample in fast["samples"]]
        wall = [statistics.median(sample["wall"] for sample in row["samples"]) for row in (serial, fast)]
        peak = max(one["operations_per_second"] for one in data["peaks"] if (one["backend"], one["precision"]) == ("openmp", "float"))
        off = fast["verification"]["visibly_differing"] / fast["verification"]["pixels"]
        text = " ".join((root / "README.md").read_text().split())
        for words in (f"{1e3 * statistics.median(kernel):.1f} ms, the median of {len(kernel)} pictures in "
                      f"{len({sample['run'] for sample in fast['samples']})} runs.", f" {100 * off:.1f} % of the pixels differ",
                      f" take {100 * fast['operations'] / statistics.median(kernel) / peak:.0f} % of the processor's",):
            self.assertIn(words, text)
        self.assertRegex(text, rf" takes {wall[0] / wall[1]:.0f} \[\d+, \d+\] times as long\.")

    def test_what_is_fresh_passes_the_check(self):
        self.assertEqual(self.figures(WORTH + TABLE, "--check"), (0, "", WORTH + TABLE))

    def test_a_changed_document_is_found_and_left_alone(self):
        stale = "\n\n" + WORTH.replace("1.50", "1.51")
        code, said, text = self.figures(stale, "--check")
        self.assertEqual((code, text), (1, stale))
        self.assertEqual(said.count("\n"), 1)
        self.assertRegex(said, r"page.md:3: 'worth hull bulb float' is stale: '1.51 .*' stands there, the results say '1.50 .*'")

    def test_a_changed_result_is_found(self):
        changed = copy.deepcopy(ABLATION)
        changed["rows"][1]["figures"]["kernel_seconds"]["median"] = 0.04
        changed["questions"]["to_first_value"][0]["ratio"]["median"] = 2.0
        self.results(changed)
        code, said, _ = self.figures(WORTH + TABLE, "--check")
        self.assertEqual(code, 1)
        self.assertEqual(said.count("\n"), 2)  # a line for the number and one for the table
        self.assertIn("the results say '2.00 [1.25, 1.75]'", said)
        self.assertIn("40.00", said)

    def test_rows_that_some_seed_misses_are_listed(self):
        self.write("flight_seeds.txt", "flight study: 2 seeds of both fractals\n\nmandelbox: 9 frames, 2 seeds, 2 of them\n" +
                   f"{'':46} {'bar':>9}{1:>8}{2:>8}    kept\n{'! steps':46} {'<= 0.2':>9}{0.1:>8}{0.2:>8}    2/2\n" +
                   f"{'  frames inside the hull, %':46} {'>= 90':>9}{95.1:>8}{88.2:>8}    1/2\n")
        code, said, text = self.figures("<!-- figures: missed --><!-- end -->\n")
        self.assertEqual((code, said), (0, ""))
        self.assertEqual(text.splitlines()[3:], ["| mandelbox | frames inside the hull, % | quality | >= 90 | 88.2 | 1 of 2 |", "<!-- end -->"])

    def test_a_file_without_the_question_is_one_line(self):
        self.results({**ABLATION, "questions": {"to_first_value": []}})
        code, said, _ = self.figures(WORTH)
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("ablation.json says nothing of without=hull in to_first_value", said)

    def test_wrong_places_are_one_line(self):
        for text, message in (
            ("It takes <!-- figures: worth hull bulb float -->1.50 times.\n", "page.md:1: .* has no <!-- end -->"),
            ("It takes <!-- figures: wroth hull -->1.50<!-- end -->.\n", "no figure is called 'wroth'"),
            ("It takes <!-- figures: worth hull -->1.50<!-- end -->.\n", "missing a required argument"),
            ("It takes <!-- figures: worth cones bulb float --><!-- end -->.\n", "ablation.json has no timed row"),
            ("It takes <!-- figures: ms nothing bulb float fast --><!-- end -->.\n", "nothing.json: No such file"),
            ("<!-- figures: worth hull bulb float -->1.50<!-- end --> times.\n", "begins a line"),
        ):
            code, said, left = self.figures(text)
            self.assertEqual((code, said.count("\n"), left), (2, 1, text), said)
            self.assertRegex(said, message)


if __name__ == "__main__":
    unittest.main()
