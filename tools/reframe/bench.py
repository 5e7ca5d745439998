# SPDX-License-Identifier: Apache-2.0
"""A ReFrame test of bench: verifies every configuration's picture, and records each kernel time as a performance
figure. reframe -c tools/reframe/bench.py -r -S BenchTest.bench=FILE, where FILE is the program."""
import json
import os

import reframe as rfm
import reframe.utility.sanity as sn
from reframe.core.builtins import run_before, sanity_function, variable


@rfm.simple_test
class BenchTest(rfm.RunOnlyRegressionTest):
    descr = "kernel times of every row of bench whose picture is proven"
    valid_systems = ["*"]
    valid_prog_environs = ["*"]
    bench = variable(str, value="bench")
    options = variable(str, value="--backend openmp")  # options of bench that select configurations
    executable_opts = ["--json", "result.json"]

    @run_before("run")
    def choose_program(self):
        self.executable = self.bench
        self.executable_opts = [*self.options.split(), "--json", "result.json"]

    def rows(self):
        with open(os.path.join(self.stagedir, "result.json"), encoding="utf-8") as file:
            return json.load(file)["rows"]

    @sanity_function
    def every_picture_is_right(self):
        wrong = [row["name"] for row in self.rows() if row["unavailable"] is None and row["figures"] is None]
        return sn.assert_eq(wrong, [], msg="no speed: {0}")

    @run_before("performance")
    def take_times(self):
        for row in self.rows():
            if row["figures"] is not None:
                seconds = row["figures"]["kernel_seconds"]["median"]
                self.perf_variables[row["name"]] = sn.make_performance_function(sn.defer(1e3 * seconds), "ms")
