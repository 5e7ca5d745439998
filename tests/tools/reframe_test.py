# SPDX-License-Identifier: Apache-2.0
"""Tests tools/reframe/bench.py on synthetic results, with a fake ReFrame, which makes the calls of a run in the same
order as ReFrame."""
import importlib.util
import json
import os
import sys
import tempfile
import types
import unittest

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "reframe", "bench.py")


def stand_in():
    """Returns a module with the part of ReFrame that bench.py uses. Its decorators return their argument, and its
    values are not deferred."""
    core = types.SimpleNamespace(run_before=lambda stage: lambda function: function, sanity_function=lambda function: function,
                                 variable=lambda kind, value: value)
    sanity = types.SimpleNamespace(assert_eq=lambda a, b, msg: a == b or failed(msg.format(a)), defer=lambda value: value,
                                   make_performance_function=lambda value, unit: (value, unit))
    reframe = types.SimpleNamespace(simple_test=lambda kind: kind, RunOnlyRegressionTest=object)
    return {"reframe": reframe, "reframe.core": types.SimpleNamespace(builtins=core), "reframe.core.builtins": core,
            "reframe.utility": types.SimpleNamespace(sanity=sanity), "reframe.utility.sanity": sanity}


def failed(text):
    raise AssertionError(text)


def row(name, seconds=None, unavailable=None):
    figures = None if seconds is None else {"kernel_seconds": {"median": seconds}}
    return {"name": name, "unavailable": unavailable, "figures": figures}


class ReframeTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        modules = stand_in()
        reframe = modules["reframe"]
        reframe.core, reframe.utility = modules["reframe.core"], modules["reframe.utility"]
        sys.modules.update(modules)
        self.addCleanup(lambda: [sys.modules.pop(name) for name in modules])
        specification = importlib.util.spec_from_file_location("reframe_bench", FILE)
        module = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
        self.test = module.BenchTest()
        self.test.stagedir = scratch.name
        self.test.perf_variables = {}

    def result(self, *rows):
        with open(os.path.join(self.test.stagedir, "result.json"), "w", encoding="utf-8") as file:
            json.dump({"rows": rows}, file)

    def test_the_program_gets_its_options(self):
        self.test.options = "--backend opencl --mode fast"
        self.test.choose_program()
        self.assertEqual(self.test.executable_opts, ["--backend", "opencl", "--mode", "fast", "--json", "result.json"])

    def test_each_proven_row_is_a_performance_figure(self):
        self.result(row("a", 0.002), row("b", unavailable="no device"))
        self.assertTrue(self.test.every_picture_is_right())
        self.test.take_times()
        self.assertEqual(self.test.perf_variables, {"a": (2.0, "ms")})

    def test_a_row_without_a_speed_fails(self):
        self.result(row("a", 0.002), row("b"))
        with self.assertRaisesRegex(AssertionError, "'b'"):
            self.test.every_picture_is_right()


if __name__ == "__main__":
    unittest.main()
