#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hip_test.py text|objects PROGRAM FOLDER COMMAND...: checks the kernels of hip, whose sources are in FOLDER. COMMAND
is the compiler with the options of exact mode. text: LLVM's intermediate representation (IR) and the assembly follow
the floating-point policy, and no kernel needs memory for registers. objects: PROGRAM has code objects of the right GPUs
with all kernels. No GPU runs them."""
import concurrent.futures
import copy
import glob
import os
import re
import struct
import subprocess
import sys

GPUS = {"gfx90a": 0x3F, "gfx942": 0x4C}  # the numbers in the flags of their code objects (LLVM's ELF.h)
IR = ["-S", "-emit-llvm"]
# Expressions of a and b that become several instructions, some of them fused, and the instruction that each has once.
EXPANDED = {"v_div_fmas_f32": ("float", "a / b"), "v_div_fmas_f64": ("double", "a / b"),
            "v_sqrt_f32": ("float", "__builtin_sqrtf(a)"), "v_rsq_f64": ("double", "__builtin_sqrt(a)"),
            "v_floor_f64": ("double", "(long long)a")}
FUSED = r"\bv_(?:pk_)?(?:fma|fmac|mac|mad)_f(?:16|32|64)"
CONTRACTION = {"exact": "off", "fast": "fast"}  # as in cmake/FloatingPoint.cmake


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

    def probe(self, precision, expression, *flags):
        """Returns the assembly of a kernel that computes the expression."""
        probe = copy.copy(self)
        probe.text = (f'extern "C" __attribute__((global)) void probe({precision} a, {precision} b, {precision}* x) '
                      f"{{ *x = {expression} + 0 * b; }}").encode()
        return probe.compiled("gfx90a", "-S", *flags).decode()

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


def faults_of_fusion(text, fused):
    """Returns the fault of exact mode's assembly text if it has more fused operations than its divisions, roots and
    conversions have. `fused`: the number that each instruction of EXPANDED stands for."""
    number = len(re.findall(FUSED, text))
    expected = sum(count * len(re.findall(rf"\b{name}", text)) for name, count in fused.items())
    return [] if number == expected else [f"{number} fused operations, expected {expected}"]


def check_text(variants):
    exact = next(variant for variant in variants if variant.name.endswith("_float_exact"))
    fused = {name: len(re.findall(FUSED, exact.probe(*probe))) for name, probe in EXPANDED.items()}

    def one(variant):
        found = []
        if variant.mode == "exact":
            found += faults_of_ir(variant.compiled("gfx90a", *IR).decode())
        for gpu in GPUS:
            text = variant.compiled(gpu, "-S").decode()
            found += faults_of_assembly(text, variant.kernels())
            if variant.mode == "exact":
                found += faults_of_fusion(text, fused)
        return [f"{variant.name}: {fault}" for fault in found]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [fault for faults in pool.map(one, variants) for fault in faults]
    # Negative controls: other flags of the compiler.
    for flag in ("-ffp-contract=fast", "-fgpu-flush-denormals-to-zero", "-fno-hip-fp32-correctly-rounded-divide-sqrt",
                 "-fapprox-func"):
        if not faults_of_ir(exact.compiled("gfx90a", *IR, flag).decode()):
            found.append(f"{flag} was not seen in the IR")
    if not faults_of_fusion(exact.compiled("gfx90a", "-S", "-ffp-contract=fast").decode(), fused):
        found.append("fused operations were not seen in the assembly")
    for flags in (["-fgpu-flush-denormals-to-zero"], ["-mllvm", "-stress-regalloc=8"]):
        if not faults_of_assembly(exact.compiled("gfx90a", "-S", *flags).decode(), exact.kernels()):
            found.append(f"{flags[-1]} was not seen in the assembly")
    # LLVM 14 compiles a square root of a float to the approximate instruction alone.
    inexact = exact.probe(*EXPANDED["v_sqrt_f32"], "-fno-hip-fp32-correctly-rounded-divide-sqrt")
    if "v_sqrt_f32" not in inexact or re.search(FUSED, inexact) or fused["v_sqrt_f32"] == 0:
        found.append("the compiler's square roots are not rounded correctly")
    return found


def code_objects(program):
    """Returns the code objects of a program's bundles by GPU (Clang's documentation, "Bundled Code Object Layout")."""
    with open(program, "rb") as file:
        data = file.read()
    found = {gpu: [] for gpu in GPUS}
    for bundle in re.finditer(b"__CLANG_OFFLOAD_BUNDLE__", data):
        at = bundle.end() + 8
        for _ in range(struct.unpack_from("<Q", data, bundle.end())[0]):
            offset, size, length = struct.unpack_from("<3Q", data, at)
            gpu = data[at + 24:at + 24 + length].decode().split("-")[-1]
            found.setdefault(gpu, []).append(data[bundle.start() + offset:bundle.start() + offset + size])
            at += 24 + length
    return found


def check_objects(variants, program):
    found = []
    objects = code_objects(program)
    for gpu, number in GPUS.items():
        for code in objects[gpu]:
            machine, flags = struct.unpack_from("<H", code, 18)[0], struct.unpack_from("<I", code, 48)[0]
            if code[:4] != b"\x7fELF" or machine != 224 or flags & 0xFF != number:
                found.append(f"not a code object for {gpu}: machine {machine}, flags {flags:#x}")
        for variant in variants:
            for kernel in variant.kernels():
                number_of_objects = sum(kernel.encode() + b".kd\0" in code for code in objects[gpu])
                if number_of_objects != 1:
                    found.append(f"{gpu}: {kernel} is in {number_of_objects} code objects")
        cones = sum(b"mandelmarch_cuda_cones" in code for code in objects[gpu])
        if cones != len(variants) / 2:
            found.append(f"negative control: {cones} of {len(objects[gpu])} code objects have kernels for cones")
    return found


def main():
    check, program, folder, *command = sys.argv[1:]
    variants = [Variant(command, file) for file in sorted(glob.glob(os.path.join(folder, "loops_*.cu")))]
    found = check_text(variants) if check == "text" else check_objects(variants, program)
    for fault in found:
        print("FAILED:", fault)
    sys.exit(bool(found) or not variants)


main()
