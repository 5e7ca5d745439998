#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_expected.py PROGRAMS LANES.json... [--gpu K40|H100] [--table FILE]: predicts the kernel time of a 1920 x 1080
frame on a GPU. Computes it from three sources: steps and iterations of each pixel, counted by PROGRAMS/render; active
lanes, counted by bench (LANES: results of the study box-vs-bulb in both modes); and the machine code of the kernels in
PROGRAMS/render."""
import argparse
import functools
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
from collections import namedtuple

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import k40
import machine_code
from table_file import put

WIDTH, HEIGHT = 1920, 1080
FRACTALS = {"mandelbulb": ("bulb", "paramsBulb.dat"), "mandelbox": ("box", "paramsBox.dat")}
LANES = 32  # per warp
# Divisions and square roots in gcc's PTX of which ptxas makes several instructions. An approximate square root becomes
# an inverse root and a reciprocal.
EXPANDED = ["div.rn.f32", "div.rn.f64", "sqrt.rn.f32", "sqrt.rn.f64"]
APPROXIMATE = {"sqrt.approx.ftz.f32": 2}
LOOPS_OF_THREADS = {"openacc": 1, "cuda": 0}  # loops over a thread's pixels; every kernel that gcc compiles has one


class Gpu:
    """A GPU. `clock`: frequency of its multiprocessors, in 1/s. `cycles`: for each pipe, the cycles that an instruction
    of a warp takes on a quarter of a multiprocessor; 1 for other pipes. `latency`: cycles until an instruction's result
    can be used."""
    def __init__(self, multiprocessors, clock, cycles, latency):
        self.multiprocessors, self.clock, self.cycles, self.latency = multiprocessors, clock, cycles, latency

    def quarters(self):
        return 4 * self.multiprocessors


# The cycles are computed from NVIDIA, "CUDA C++ Programming Guide", table "Throughput of Native Arithmetic
# Instructions", which has the lanes per cycle and multiprocessor. Capability 9.0 has 64 for double, integers,
# comparisons, minima and selects, and 16 for special functions. Capability 3.5 has 64 for double, and 32 for special
# functions and conversions. The latencies are from the same guide's section "Multiprocessor Level": about 11 cycles for
# capability 3.x, 4 for 7.x and newer.
HOPPER = {"double": 2, "half": 2, "special": 8}
GPUS = {
    # NVIDIA, "Tesla K40 GPU Active Accelerator", board specification, 2013. A quarter of a multiprocessor can issue two
    # instructions per cycle, but the prediction assumes one.
    "K40": Gpu(15, 745e6, {"double": 2, "special": 4}, 11),
    # NVIDIA, "NVIDIA H100 Tensor Core GPU", data sheet, 2023, SXM. The clock follows from its 67 TFLOP/s, for 132
    # multiprocessors with 128 lanes of fused multiply-adds. The same holds for the H200.
    "H100": Gpu(132, 1.98e9, HOPPER, 4),
}


def code_sizes(cubin):
    """Returns the number of instructions of each function of a cubin for sm_35. An instruction is a word of 8 bytes.
    One word in eight is not an instruction, but information for the scheduler."""
    at, = struct.unpack_from("<Q", cubin, 40)
    entry, count, names = struct.unpack_from("<HHH", cubin, 58)
    sections = [struct.unpack_from("<IIQQQQ", cubin, at + i * entry) for i in range(count)]
    strings = sections[names][4]
    sizes = {}
    for name, _, _, _, _, size in sections:
        text = cubin[strings + name:cubin.index(b"\0", strings + name)].decode()
        if text.startswith(".text."):
            sizes[text.removeprefix(".text.")] = size // 8 * 7 // 8
    return sizes


def expansion(operation):
    """Returns the number of instructions of a division or square root on sm_35. `operation`: its PTX name. If ptxas inlines the operation, this is
    the number of instructions that each further operation adds to a kernel. If ptxas calls a function, it is the number
    that the first operation adds to a kernel."""
    word, *_, suffix = operation.split(".")

    def kernel(times):
        steps = "".join(f"{operation} %a, {'%a, %b' if word == 'div' else '%a'};\n" for _ in range(times))
        text = (f".version 3.1\n.target sm_35\n.address_size 64\n.visible .entry k(.param .u64 p) {{\n.reg .u64 %p;\n"
                f".reg .{suffix} %a, %b;\nld.param.u64 %p, [p];\nld.global.{suffix} %a, [%p];\nld.global.{suffix} %b, [%p+8];\n"
                f"{steps}st.global.{suffix} [%p], %a;\nret;\n}}\n")
        with k40.assembled(text, k40.pinned("ptxas_11"), "sm_35") as (cubin, _), open(cubin, "rb") as file:
            return code_sizes(file.read())["k"]
    each = (kernel(41) - kernel(1)) / 40
    return each if each > 2 else kernel(1) - kernel(0)


def marches(render, gpu):
    """Returns the March (machine_code.py) of each kernel on the GPU, by backend, fractal, precision and mode."""
    found = {}
    for backend, texts in (("openacc", k40.extract(render)), ("cuda", k40.extract_cuda(render))):
        for text in texts:
            if gpu.cycles is HOPPER:
                with k40.assembled(text, k40.pinned("ptxas_13"), "sm_90", ["-c"]) as (cubin, _):
                    codes = machine_code.sass(k40.pinned("nvdisasm"), cubin)
            elif backend == "cuda":
                continue  # nvcc compiles kernels only for newer GPUs
            else:
                weights = APPROXIMATE | {name: expansion(name) for name in EXPANDED}
                codes = {name: machine_code.ptx(body, weights) for name, body in k40.kernels(text)}
            for name, code in codes.items():
                kind = re.search(r"march_(mandel\w+)_(float|double)_(exact|fast)(?:\$_omp_fn\$0)?$", name)
                if kind and kind[1] in FRACTALS:
                    found[(backend, *kind.groups())] = machine_code.march_of(code, gpu.cycles, LOOPS_OF_THREADS[backend])
    return found


# A count: its sum over a picture's pixels, and its value for the longest ray.
Counts = namedtuple("Counts", "total longest")


@functools.cache
def drawn(render, fractal, precision, mode):
    """Returns steps and iterations of each pixel of the official scene, as openacc's kernels take them on this machine."""
    import OpenEXR
    name, parameters = FRACTALS[fractal]
    with tempfile.TemporaryDirectory() as folder:
        picture = os.path.join(folder, "picture.exr")
        subprocess.run([render, "--fractal", name, parameters, "--size", f"{WIDTH}x{HEIGHT}", "--precision", precision, "--mode", mode,
                        "--backend", "openacc", "--output", picture], check=True)
        with OpenEXR.File(picture, separate_channels=True) as file:
            return tuple(file.channels()[channel].pixels.astype(int) for channel in ("steps", "iterations"))


def counted(pixels, march):
    """Returns the Counts of steps and of iterations. `pixels`: the steps and iterations of each pixel. The longest ray
    is the ray that executes the most instructions."""
    steps, iterations = pixels
    longest = (march.step_instructions * steps + march.round_instructions * iterations).argmax()
    return tuple(Counts(int(values.sum()), int(values.flat[longest])) for values in pixels)


def active_lanes(counts, refills):
    """Returns the fractions of a warp's lanes that are active in steps and in iterations."""
    use = next(use for use in counts["lane_use"] if use["lanes"] == LANES)
    active = use["refilled" if refills else "together"]
    return active["in_steps"], active["in_iterations"]


def expected(gpu, march, steps, iterations, lanes):
    """Returns two times in seconds: that of the whole march if no cycle is idle, and that of the longest ray if its
    warp waits for the result of each instruction."""
    cycles = march.step_cycles * steps.total / lanes[0] + march.round_cycles * iterations.total / lanes[1]
    alone = (march.step_instructions * steps.longest + march.round_instructions * iterations.longest) * gpu.latency
    return cycles / LANES / gpu.quarters() / gpu.clock, alone / gpu.clock


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        sys.exit(f"gpu_expected: {path}: {error}, expected a result of bench")


def table(name, render, lanes):
    gpu = GPUS[name]
    found = marches(render, gpu)
    lines = [f"{name} on paper, {WIDTH} x {HEIGHT}, the march's kernel time; {gpu.multiprocessors} multiprocessors at {gpu.clock / 1e9:.3g} GHz",
             f"{'fractal':<12}{'precision':<11}{'mode':<7}{'backend':<9}{'cycles':>8}{'cycles':>8}{'active in':>11}{'active in':>12}{'all cycles':>12}"
             f"{'longest':>10}{'expected, ms':>15}",
             f"{'':<39}{'a round':>8}{'a step':>8}{'steps':>11}{'iterations':>12}{'used, ms':>12}{'ray, ms':>10}{'from':>8}{'to':>7}"]
    for fractal, precision, mode in sorted({key[1:] for key in found}):
        for backend in ("openacc", "cuda"):
            march = found.get((backend, fractal, precision, mode))
            if march is None:
                continue
            steps, iterations = counted(drawn(render, fractal, precision, mode), march)
            active = active_lanes(lanes[fractal, precision, mode], march.refills)
            used, longest = expected(gpu, march, steps, iterations, active)
            lines.append(f"{fractal:<12}{precision:<11}{mode:<7}{backend:<9}{march.round_cycles:>8.0f}{march.step_cycles:>8.0f}{active[0]:>11.0%}"
                         f"{active[1]:>12.0%}{1e3 * used:>12.3g}{1e3 * longest:>10.3g}{1e3 * max(used, longest):>8.3g}{1e3 * (used + longest):>7.3g}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs")
    parser.add_argument("lanes", nargs="+")
    parser.add_argument("--gpu", choices=GPUS, default="K40")
    parser.add_argument("--table")
    arguments = parser.parse_args()
    render = os.path.join(arguments.programs, "render")
    if len(k40.extract(render)) != 1:
        sys.exit(f"gpu_expected: {render} holds {len(k40.extract(render))} texts of PTX of openacc, expected one")
    lanes = {(c["fractal"], c["precision"], c["mode"]): c for path in arguments.lanes for c in read(path)["counts"]
             if c["setting"]["view"] == "official"}
    try:
        put(table(arguments.gpu, render, lanes), arguments.table)
    except k40.Unavailable as error:
        sys.exit(f"gpu_expected: {error}")


if __name__ == "__main__":
    main()
