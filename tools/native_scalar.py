#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""native_scalar.py BUILD [--rounds N] [--table FILE]: measures the gain from -march=native for the scalar kernel, which
is compiled for baseline x86-64.

Compiles openmp's scalar kernels of a build again with -march=native, links them into a copy of its bin/render, and
renders the official scenes with both programs, back to back in random order, on one thread. The clock is the user time
of the process, which excludes waiting for a core. Ratios are those of pairs; the interval is Student's t of their
logarithms."""
import argparse
import math
import os
import random
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

from table_file import put

FRACTALS = {"mandelbulb": "paramsBulb.dat", "mandelbox": "paramsBox.dat"}
SIZE = "540x540"
FLAG = "-march=native"
ROUNDS = 16
T_95 = {8: 2.3646, 12: 2.2010, 16: 2.1314, 20: 2.0930, 24: 2.0687}  # Student's t, by the number of pairs


def run(command, folder=None):
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode != 0:
        sys.exit(f"native_scalar: {shlex.join(command)[:200]}: {done.stderr.strip()[-400:]}")
    return done.stdout


def shell(line, folder):
    return run(["bash", "-c", line], folder)


def native_render(build, scratch):
    """Builds the second program. Returns its path, the flags of the kernels, and their multiply-adds by mode."""
    lines = run(["ninja", "-C", build, "-t", "commands", "bin/render"]).splitlines()
    kernels = [line for line in lines if re.search(r"/openmp/scalar_mandel(bulb|box)_\w+\.cpp$", line)]
    archive, program = "backends/openmp/libmandelmarch_openmp.a", os.path.join(scratch, "render")
    copy = os.path.join(scratch, os.path.basename(archive))
    link = next((line for line in reversed(lines) if " -o bin/render " in line and f" {archive} " in line), None)
    if len(kernels) != 8 or link is None:
        sys.exit(f"native_scalar: {build}: no bin/render with eight scalar kernels, expected a build of the release preset by ninja")
    shell(f"cp {archive} {copy}", build)
    fused = {"exact": 0, "fast": 0}
    for line in kernels:
        old = re.search(r" -o (\S+)", line)[1]
        new = os.path.join(scratch, os.path.basename(old))
        shell(re.sub(r" -MD -MT \S+ -MF \S+ -o \S+", f" {FLAG} -o {new}", line), build)
        fused["fast" if "_fast." in old else "exact"] += len(re.findall(r"\bvfn?m(?:add|sub)", run(["objdump", "-d", new])))
        run(["ar", "r", copy, new])
    shell(link.replace(f" {archive} ", f" {copy} ").replace(" -o bin/render ", f" -o {program} "), build)
    flags = [word for word in kernels[0].split() if word.startswith(("-O", "-m", "-ffp-contract"))]
    return program, " ".join(dict.fromkeys(flag for flag in flags if "contract" not in flag)), fused


def options(fractal, precision, mode, output):
    return ["--fractal", fractal, FRACTALS[fractal], "--backend", "openmp", "--simd-width", "1", "--threads", "1", "--size", SIZE, "--precision", precision, "--mode", mode, "--output", output]


def user_seconds(program, arguments):
    """Returns the user time of a process that renders one picture."""
    before = os.times().children_user
    run([program, *arguments])
    return os.times().children_user - before


def measured(programs, case, rounds, scratch):
    """Returns (ratio, low, high): how many times as fast the second program is."""
    logs = []
    for _ in range(rounds):
        seconds = {}
        for program in random.sample(programs, 2):
            seconds[program] = user_seconds(program, options(*case, os.path.join(scratch, "picture.bmp")))
        logs.append(math.log(seconds[programs[0]] / seconds[programs[1]]))
    half = T_95[rounds] * statistics.stdev(logs) / math.sqrt(rounds)
    mean = statistics.mean(logs)
    return [math.exp(mean + part) for part in (0, -half, half)]


def same_bits(programs, case, scratch):
    """Returns true if both programs give the same EXR picture: the colours not rounded to bytes, and the depths."""
    pictures = []
    for number, program in enumerate(programs):
        pictures.append(os.path.join(scratch, f"{number}.exr"))
        run([program, *options(*case, pictures[-1])])
    contents = [open(path, "rb").read() for path in pictures]
    return contents[0] == contents[1]


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        found = dict(re.findall(r"^(model name|cpu family|model)\s*: (.*)$", file.read(), re.M))
    return f"{found['model name']} (family {found['cpu family']} model {found['model']}), {len(os.sched_getaffinity(0))} threads"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--rounds", type=int, choices=T_95, default=ROUNDS)
    parser.add_argument("--table")
    args = parser.parse_args()
    build = os.path.abspath(args.build)
    compiler = run(["g++", "-dumpfullversion"]).strip()
    named = re.search(r"-march=\s+(\S+)", run(["g++", FLAG, "-Q", "--help=target"]))[1]
    with tempfile.TemporaryDirectory() as scratch:
        native, flags, fused = native_render(build, scratch)
        programs = [os.path.join(build, "bin", "render"), native]
        load = os.getloadavg()[0]
        lines = []
        for case in ((f, p, m) for f in FRACTALS for p in ("double", "float") for m in ("exact", "fast")):
            ratio, low, high = measured(programs, case, args.rounds, scratch)
            bits = ("same bits" if same_bits(programs, case, scratch) else "OTHER BITS") if case[2] == "exact" else "-"
            lines.append(f"{case[0]:12}{case[1]:11}{case[2]:7}{ratio:8.3f}{low:9.3f}{high:9.3f}   {bits}")
        text = "\n".join([
            f"scalar text with {FLAG}: user time of the present program over that of the native one, {args.rounds} pairs of pictures of {SIZE} on one thread",
            f"processor  {processor()}",
            f"compiler   g++ {compiler}; present flags {flags}; {FLAG} is {named}",
            f"fused      {fused['exact']} multiply-adds in the native exact kernels, {fused['fast']} in the fast ones",
            f"load       {load:.1f} at the start, {os.getloadavg()[0]:.1f} at the end",
            "",
            f"{'fractal':12}{'precision':11}{'mode':7}{'ratio':>8}{'low':>9}{'high':>9}   picture",
            *lines,
            "",
        ])
    put(text, args.table)
    return 1 if "OTHER BITS" in text else 0


if __name__ == "__main__":
    sys.exit(main())
