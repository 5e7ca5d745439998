#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ptx_test.py text|assemble PROGRAM FRACTAL...: checks the PTX in a built program. text: the PTX follows the
floating-point policy. assemble: ptxas compiles the PTX without spilling registers. Each check has mutants that must
fail. Exit code 77: the pinned ptxas is missing, and CI is not set."""
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import ptx_to_c  # noqa: E402
from ptx_to_c import KERNEL, PEAK, kernels  # noqa: E402

# For each GPU: its architecture, and the end of the path in build/venv of its assembler, which tools/gpu_packages.txt
# installs. ptxas 11 is the last one that supports sm_35; ptxas 13 matches NVIDIA's driver 580.
GPUS = {"K40": ("sm_35", "cuda_nvcc/bin/ptxas"), "H100": ("sm_90", "cu13/bin/ptxas")}
# Allowed registers per thread, by precision. With this many registers, a multiprocessor of the K40 can hold 5 (float) or 3
# (double) blocks of 128 threads at once, and one of the H100 4 or 3.
MOST_REGISTERS = {"K40": {"float": 96, "double": 168}, "H100": {"float": 104, "double": 168}}

# A floating-point instruction: its name with all suffixes.
OPERATION = re.compile(r"(?<![\w.%$])([a-z]\w*(?:\.\w+)*\.f(?:32|64)(?:\.\w+)*)(?=\s)")
ARITHMETIC = {"add", "sub", "mul", "div", "sqrt", "rcp", "fma"}
EXACT_BY_NATURE = {"mov", "ld", "st", "setp", "selp", "neg", "abs", "cvt"}
# Operations that only the kernels of fast mode have, and those that these kernels must not have.
QUICK = {"lg2.approx.ftz.f32", "sqrt.approx.ftz.f32", "rsqrt.approx.ftz.f32", "rcp.approx.ftz.f32", "max.f32", "min.f32",
         "rsqrt.approx.ftz.f64", "rcp.approx.ftz.f64", "testp.normal.f64"}
SLOW = {"sqrt.rn.f32", "rcp.rn.f32", "sqrt.rn.f64", "rcp.rn.f64"}


class Unavailable(Exception):
    pass


def pinned(assembler):
    """Returns the path of an assembler of GPUS. Raises Unavailable if it is not installed."""
    for folder, _, files in os.walk(os.path.join("build", "venv")):
        for name in files:
            if os.path.join(folder, name).endswith(assembler):
                return os.path.join(folder, name)
    raise Unavailable(f"build/venv has no {assembler}: tools/python_packages gpu_packages")


def resources(ptx, gpu):
    """Assembles a PTX module for a GPU, as a linkable object (ptxas -c), as the driver does with the code that gcc's
    run-time library passes to cuLinkAddData. Returns, by kernel, the registers, the bytes of stack, and the bytes of
    spill stores and loads together."""
    architecture, assembler = GPUS[gpu]
    ptxas = pinned(assembler)
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "kernels.ptx")
        with open(source, "w", encoding="utf-8") as file:
            file.write(ptx)
        run = subprocess.run([ptxas, "-v", "-c", f"-arch={architecture}", source, "-o", os.path.join(folder, "cubin")],
                             capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(f"{ptxas} -arch={architecture}: {run.stdout}{run.stderr}")
    found = re.findall(r"Compiling entry function '(\S+)\$_omp_fn\$0'.*?(\d+) bytes stack frame, (\d+) bytes spill stores, "
                       r"(\d+) bytes spill loads.*?Used (\d+) registers", run.stdout + run.stderr, re.S)
    return {name: (int(registers), int(stack), int(stores) + int(loads)) for name, stack, stores, loads, registers in found}


def operation_faults(name, body, precision, mode):
    for operation in sorted(set(OPERATION.findall(body))):
        word = operation.split(".")[0]
        suffixes = operation.split(".")[1:]
        if precision == "float" and "f64" in suffixes:
            yield f"{name}: {operation}: double in a float kernel"
        if mode == "fast" and operation in QUICK:
            continue
        if mode == "fast" and operation in SLOW:
            yield f"{name}: {operation}: not an approximation, in fast mode"
        if "ftz" in suffixes or "approx" in suffixes or word not in ARITHMETIC | EXACT_BY_NATURE:
            yield f"{name}: {operation}: not an operation that IEEE 754 rounds"
        if word in ARITHMETIC and "rn" not in suffixes:
            yield f"{name}: {operation}: without .rn, so that it may be fused"
        if word == "fma" and mode == "exact":
            yield f"{name}: {operation}: fused in exact mode"


def faults(ptx, fractals):
    """Returns the violations of docs/floating-point.md in a PTX module, each as a line of text."""
    found = [f".target {target}" for target in re.findall(r"^\.target (\S+)", ptx, re.M) if target != "sm_35"]
    if re.search(r"^\.(visible )?func ", ptx, re.M):
        found.append("a function that is called instead of inlined")
    wanted = {(kind, fractal, precision, mode) for kind in ("cones", "draw") for fractal in fractals
              for precision in ("float", "double") for mode in ("exact", "fast") if (kind, mode) != ("cones", "exact")}
    for entry in ptx_to_c.ENTRY.finditer(ptx):
        if ".maxntid 128, 1, 1" not in entry[0]:
            found.append(f"{entry[1]}: does not say how many threads its blocks have")
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
        # Searches the whole body, not only the instructions that OPERATION matches, so that none is missed.
        if match[3] == "float" and ".f64" in body:
            found.append(f"{name}: .f64 in a float kernel")
        if ".local" in body:
            found.append(f"{name}: variables in local memory")
    found += ["no kernel " + "_".join(missing) for missing in sorted(wanted)]
    if fused == 0:
        found.append("no fast kernel has a fused multiply-add")
    return sorted(set(found))


def changed(ptx, kernel, old, new):
    """Returns the PTX with the first match of the pattern `old` in one kernel replaced by `new`."""
    body = next(body for name, body in kernels(ptx) if name.startswith(kernel))
    mutant = re.sub(old, new, body, count=1)
    assert mutant != body, f"{kernel} holds no {old}"
    return ptx.replace(body, mutant)


def check_text(ptx, fractals):
    found = faults(ptx, fractals)
    draw = f"draw_{fractals[0]}"
    mutants = {
        "fused": changed(ptx, f"{draw}_double_exact", r"mul\.rn\.f64 (%r\d+),(%r\d+),(\S+);", r"fma.rn.f64 \1,\2,\3,\2;"),
        "double in a float": changed(ptx, f"{draw}_float_fast", r"add\.rn\.f32", "add.rn.f64"),
        "a double's register": changed(ptx, f"{draw}_float_exact", r"\.reg \.f32 (%r\d+);", r".reg .f64 \1;"),
        "without .rn": changed(ptx, f"{draw}_float_exact", r"mul\.rn\.f32", "mul.f32"),
        "behind a predicate": changed(ptx, f"{draw}_float_exact", r"mul\.rn\.f32", "@ ! %r1 mul.f32"),
        "approximate": changed(ptx, f"{draw}_float_exact", r"sqrt\.rn\.f32", "sqrt.approx.ftz.f32"),
        "approximate double": changed(ptx, f"{draw}_double_exact", r"sqrt\.rn\.f64", "rsqrt.approx.ftz.f64"),
        "not approximate": changed(ptx, f"{draw}_float_fast", r"sqrt\.approx\.ftz\.f32", "sqrt.rn.f32"),
        "max": changed(ptx, f"{draw}_float_exact", r"selp\.f32 (%r\d+),([^,]+),([^,]+),%r\d+;", r"max.f32 \1,\2,\3;"),
        "flushing": changed(ptx, f"{draw}_float_fast", r"add\.rn\.f32", "add.rn.ftz.f32"),
        "another target": ptx.replace(".target sm_35", ".target sm_70"),
        "blocks of an unknown size": re.sub(r"\.maxntid 128, 1, 1\n", "", ptx, count=1),
        "a kernel less": ptx.replace(f".entry {draw}_float_fast", f".entry {draw}_float_quick"),
    }
    for name, mutant in mutants.items():
        if not faults(mutant, fractals):
            found.append(f"the mutant '{name}' was not detected")
    return found


def spills(results):
    return [f"{name}: {stack} bytes of stack, {spilled} of spills" for name, (_, stack, spilled) in results.items()
            if stack or spilled]


def check_assembled(ptx, fractals):
    found = []
    for gpu in GPUS:
        results = resources(ptx, gpu)
        found += [f"{gpu}: {fault}" for fault in spills(results)]
        if len(results) != 6 * len(fractals) + 2:
            found.append(f"{gpu}: {len(results)} kernels assembled, the two of the peak included")
        for name, (registers, _, _) in results.items():
            if PEAK.match(name + "$_omp_fn$0"):
                continue
            most = MOST_REGISTERS[gpu][re.match(KERNEL, name + "$_omp_fn$0")[3]]
            if registers > most:
                found.append(f"{gpu}: {name}: {registers} registers, {most} expected at most")
    if not spills(resources(ptx.replace(".maxntid 128, 1, 1", ".maxntid 128, 1, 1\n.minnctapersm 16"), "K40")):
        found.append("the negative control with 32 registers spills nothing")
    return found


def main():
    check = {"text": check_text, "assemble": check_assembled}[sys.argv[1]]
    texts = ptx_to_c.extract(sys.argv[2])
    if len(texts) != 1:
        sys.exit(f"{len(texts)} PTX texts in {sys.argv[2]}, expected 1")
    try:
        found = check(texts[0], sys.argv[3:])
    except Unavailable as error:
        print(error)
        sys.exit(1 if "CI" in os.environ else 77)
    for fault in found:
        print("FAILED:", fault)
    sys.exit(bool(found))


main()
