#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hip_test.py FOLDER COMMAND...: checks the kernels of hip, whose sources are in FOLDER. COMMAND is the compiler with
the options of exact mode. LLVM's intermediate representation (IR) and the assembly follow the floating-point policy, and
no kernel needs memory for registers. No GPU runs them."""
import concurrent.futures
import glob
import os
import re
import subprocess
import sys

GPUS = ["gfx90a", "gfx942"]
IR = ["-S", "-emit-llvm"]
CONTRACTION = {"exact": "off", "fast": "fast"}  # as in cmake/Flags.cmake


class Variant:
    """The kernels of a fractal, precision and mode. `file`: their source."""

    def __init__(self, command, file):
        self.command = command
        self.name = os.path.basename(file).removeprefix("loops_").removesuffix(".cpp.cu")
        self.mode = self.name.split("_")[-1]
        with open(file, "rb") as source:
            self.text = source.read()

    def kernels(self):
        kinds = ["march", "shade", "bytes"] + ["cones"] * (self.mode == "fast")
        return sorted(f"mandelmarch_cuda_{kind}_{self.name}" for kind in kinds)

    def compiled(self, gpu, *flags):
        command = [*self.command, "-Wall", "-Wextra", "-Werror", f"-ffp-contract={CONTRACTION[self.mode]}",
                   f"--offload-arch={gpu}", *flags, "-", "-o", "-"]
        result = subprocess.run(command, input=self.text, capture_output=True)
        if result.returncode:
            sys.exit(f"{self.name}: {result.stderr.decode()[:1000]}")
        return result.stdout


def faults_of_ir(ir):
    """Returns the faults of exact mode's IR."""
    found = []
    instructions = [line for line in ir.splitlines() if line.startswith("  ")]
    patterns = {"an operation that may be fused or changed": r" (contract|reassoc|nnan|ninf|nsz|arcp|afn|fast) ",
                "a fused operation": r"@llvm\.fm(a|uladd)\.", "an inexact operation": r"!fpmath",
                "an approximation": r"@llvm\.amdgcn\.(rcp|rsq|sqrt|log)"}
    for what, pattern in patterns.items():
        lines = [line for line in instructions if re.search(pattern, line)]
        if lines:
            found.append(f"{what}: {lines[0].strip()}")
    if "denormal-fp-math" in ir:
        found.append("subnormal numbers are not kept")
    if sum(bool(re.search(r"= f(add|sub|mul|div) ", line)) for line in instructions) < 100:
        found.append("hardly an operation")
    return found


def faults_of_assembly(text, kernels):
    """Returns the faults of an assembly text: modes, and memory for registers."""
    found = []
    if sorted(re.findall(r"\.amdhsa_kernel (\S+)", text)) != kernels:
        found.append(f"kernels: {kernels} expected")
    for setting, value in (("float_denorm_mode_32", "3"), ("float_denorm_mode_16_64", "3"),
                           ("float_round_mode_32", "0"), ("float_round_mode_16_64", "0"),
                           ("private_segment_fixed_size", "0"), ("uses_dynamic_stack", "0")):
        values = re.findall(rf"\.amdhsa_{setting} (\S+)", text)
        if values != [value] * len(kernels):
            found.append(f"{setting}: {values}, expected {value}")
    return found


def faults_of(variants):
    exact = next(variant for variant in variants if variant.name.endswith("_float_exact"))

    def one(variant):
        found = []
        if variant.mode == "exact":
            found += faults_of_ir(variant.compiled("gfx90a", *IR).decode())
        for gpu in GPUS:
            found += faults_of_assembly(variant.compiled(gpu, "-S").decode(), variant.kernels())
        return [f"{variant.name}: {fault}" for fault in found]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [fault for faults in pool.map(one, variants) for fault in faults]
    # Negative controls: other flags of the compiler.
    for flag in ("-ffp-contract=fast", "-fgpu-flush-denormals-to-zero", "-fno-hip-fp32-correctly-rounded-divide-sqrt",
                 "-fapprox-func"):
        if not faults_of_ir(exact.compiled("gfx90a", *IR, flag).decode()):
            found.append(f"{flag} was not seen in the IR")
    for flags in (["-fgpu-flush-denormals-to-zero"], ["-mllvm", "-stress-regalloc=8"]):
        if not faults_of_assembly(exact.compiled("gfx90a", "-S", *flags).decode(), exact.kernels()):
            found.append(f"{flags[-1]} was not seen in the assembly")
    return found


def main():
    folder, *command = sys.argv[1:]
    variants = [Variant(command, file) for file in sorted(glob.glob(os.path.join(folder, "loops_*.cu")))]
    found = faults_of(variants) if variants else ["no kernels"]
    for fault in found:
        print("FAILED:", fault)
    sys.exit(bool(found))


main()
