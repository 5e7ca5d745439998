#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""k40.py PROGRAM [--table FILE]: the OpenACC kernels' PTX in a built program: what it may hold, and what NVIDIA's assembler
makes of it: registers, spills, and how many threads of the Tesla K40 they leave running."""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

from table_file import put

PINNED = os.path.join("build", "venv")  # tools/python_packages.txt
BLOCK = 128  # threads: block_threads in core/job/job.h
KERNEL = re.compile(r"(march|shade|bytes)_(\w+)_(float|double)_(exact|fast)\$_omp_fn\$0$")
PEAK = re.compile(r"multiply_adds_(float|double)\$_omp_fn\$0$")  # the device's peak: fused on purpose
# A declaration ends with a semicolon instead.
ENTRY = re.compile(r"^\.entry (\S+) \([^)]*\)\s*(?:\.(?:maxntid|minnctapersm) [\d, ]+\s*)*\{", re.M)
# An instruction on floating-point numbers, its name with all suffixes, wherever it stands in a line.
OPERATION = re.compile(r"(?<![\w.%$])([a-z]\w*(?:\.\w+)*\.f(?:32|64)(?:\.\w+)*)(?=\s)")
ARITHMETIC = {"add", "sub", "mul", "div", "sqrt", "rcp", "fma"}
EXACT_BY_NATURE = {"mov", "ld", "st", "setp", "selp", "neg", "abs", "cvt"}


class Unavailable(Exception):
    pass


def extract(program):
    """The PTX texts with OpenACC's kernels that stand in a program's file, each from its preamble to the string's end."""
    with open(program, "rb") as file:
        data = file.read()
    texts = [text.decode("ascii") for text in re.findall(rb"// BEGIN PREAMBLE\n\.version[^\0]*", data)]
    return [text for text in texts if any(KERNEL.match(name) or PEAK.match(name) for name, _ in kernels(text))]


def kernels(ptx):
    """Names and bodies; a body may hold blocks in braces."""
    found = []
    for entry in ENTRY.finditer(ptx):
        depth = 1
        for brace in re.finditer(r"[{}]", ptx[entry.end():]):
            depth += 1 if brace[0] == "{" else -1
            if depth == 0:
                found.append((entry[1], ptx[entry.end():entry.end() + brace.start()]))
                break
    return found


def operation_faults(name, body, precision, mode):
    for operation in sorted(set(OPERATION.findall(body))):
        word = operation.split(".")[0]
        suffixes = operation.split(".")[1:]
        if precision == "float" and "f64" in suffixes:
            yield f"{name}: {operation}: double in a float kernel"
        if "ftz" in suffixes or "approx" in suffixes or word not in ARITHMETIC | EXACT_BY_NATURE:
            yield f"{name}: {operation}: not an operation that IEEE 754 rounds"
        if word in ARITHMETIC and "rn" not in suffixes:
            yield f"{name}: {operation}: without .rn, so that it may be fused"
        if word == "fma" and mode == "exact":
            yield f"{name}: {operation}: fused in exact mode"


def faults(ptx, fractals):
    """What is wrong with a PTX text, in sentences; nothing if it keeps the policy of docs/floating-point.md."""
    found = [f".target {target}" for target in re.findall(r"^\.target (\S+)", ptx, re.M) if target != "sm_35"]
    if re.search(r"^\.(visible )?func ", ptx, re.M):
        found.append("a function that is called instead of inlined")
    wanted = {(kind, fractal, precision, mode) for kind in ("march", "shade", "bytes") for fractal in fractals
              for precision in ("float", "double") for mode in ("exact", "fast")}
    for entry in ENTRY.finditer(ptx):
        if ".maxntid 128, 1, 1" not in entry[0]:
            found.append(f"{entry[1]}: does not say how many threads its blocks have")
        if re.match(r"shade_|march_\w+_double_fast", entry[1]) and ".minnctapersm" not in entry[0]:
            found.append(f"{entry[1]}: does not say how many blocks a multiprocessor shall hold")
    fused = 0
    for name, body in kernels(ptx):
        match = KERNEL.match(name)
        if peak := PEAK.match(name):
            found += operation_faults(name, body, peak[1], "fast")
            continue
        if not match:
            found.append(f"{name}: an unknown kernel")
            continue
        wanted.discard(match.groups())
        fused += match[4] == "fast" and "fma.rn" in body
        found += operation_faults(name, body, match[3], match[4])
        # By suffix, as no instruction's name may hide one: registers too.
        if match[3] == "float" and ".f64" in body:
            found.append(f"{name}: .f64 in a float kernel")
        if ".local" in body:
            found.append(f"{name}: variables in local memory")
    found += ["no kernel " + "_".join(missing) for missing in sorted(wanted)]
    if fused == 0:
        found.append("no fast kernel has a fused multiply-add")
    return sorted(set(found))


def release(ptxas):
    text = subprocess.run([ptxas, "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(int(number) for number in re.search(r"release (\d+)\.(\d+)", text).groups())


def pinned_ptxas():
    for folder, _, files in os.walk(PINNED):
        if "ptxas" in files:
            return os.path.join(folder, "ptxas")
    raise Unavailable(f"no ptxas in {PINNED}: make python")


def newer_ptxas():
    """A ptxas of CUDA 12 or later on PATH or where CUDA installs it, or None."""
    for path in (shutil.which("ptxas"), "/usr/local/cuda/bin/ptxas"):
        if path and os.path.exists(path) and release(path)[0] >= 12:
            return path
    return None


def assemble(ptx, ptxas, architecture, options=()):
    """Per kernel: registers, bytes of stack, bytes of spill stores and loads."""
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "kernels.ptx")
        with open(source, "w", encoding="utf-8") as file:
            file.write(ptx)
        run = subprocess.run([ptxas, "-v", f"-arch={architecture}", *options, source, "-o", os.path.join(folder, "cubin")],
                             capture_output=True, text=True, check=False)
    said = run.stdout + run.stderr
    if run.returncode != 0:
        raise RuntimeError(f"{ptxas} -arch={architecture}: {said}")
    found = re.findall(r"Compiling entry function '(\S+)\$_omp_fn\$0'.*?(\d+) bytes stack frame, (\d+) bytes spill stores, "
                       r"(\d+) bytes spill loads.*?Used (\d+) registers", said, re.S)
    return {name: (int(registers), int(stack), int(stores) + int(loads)) for name, stack, stores, loads, registers in found}


def k40_threads(registers):
    """Threads that a multiprocessor of the K40 (compute capability 3.5) holds at once: 65,536 registers, given to warps in
    units of 256; 64 warps and 16 blocks at most."""
    warps = BLOCK // 32
    per_warp = -(-registers * 32 // 256) * 256
    return min(65536 // per_warp // warps, 64 // warps, 16) * BLOCK


def table(ptx):
    ptxas = pinned_ptxas()
    lines = [f"ptxas {'.'.join(map(str, release(ptxas)))}, sm_35, blocks of {BLOCK} threads; K40: 2048 threads a multiprocessor",
             f"{'kernel':<36}{'registers':>10}{'stack':>7}{'spills':>8}{'threads':>9}{'occupancy':>11}"]
    for name, (registers, stack, spills) in sorted(assemble(ptx, ptxas, "sm_35").items()):
        threads = k40_threads(registers)
        lines.append(f"{name:<36}{registers:>10}{stack:>7}{spills:>8}{threads:>9}{threads / 2048:>10.1%}")
    newer = newer_ptxas()
    for architecture in ("sm_75", "sm_90"):
        if newer is None:
            lines.append(f"{architecture}: no newer ptxas found")
            continue
        results = assemble(ptx, newer, architecture).values()
        lines.append(f"{architecture}, ptxas {'.'.join(map(str, release(newer)))}: {len(results)} kernels, at most "
                     f"{max(r for r, _, _ in results)} registers, {sum(s for _, _, s in results)} bytes of spills")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--table", help="write the table to this file too")
    arguments = parser.parse_args()
    try:
        text = "".join(table(ptx) for ptx in extract(arguments.program))
    except Unavailable as error:
        sys.exit(f"k40: {error}")
    if not text:
        sys.exit(f"k40: {arguments.program} holds no PTX: it was built without openacc")
    put(text, arguments.table)


if __name__ == "__main__":
    main()
