#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ptx_test.py text|assemble PROGRAM FRACTAL...: the PTX in a built program keeps the floating-point policy, and ptxas takes
it without spills. Each check has broken twins that must fail. Exit code 77: no pinned ptxas."""
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools"))
import k40  # noqa: E402
import gpu_expected  # noqa: E402

# The K40's steps: 10, 5, 7, 4 and 16 blocks of 128 threads on a multiprocessor.
MOST_REGISTERS = {("march", "float"): 48, ("march", "double"): 96, ("shade", "float"): 72, ("shade", "double"): 128,
                  ("bytes", "float"): 32, ("bytes", "double"): 32}
MORE_REGISTERS = {
    "march_mandelbox_float_fast": 53,  # 9 blocks: lanes that refill
    "march_mandelbulb_float_fast": 49,  # 9 blocks: the camera's table
}


def changed(ptx, kernel, old, new):
    """The PTX with the first match of `old` in one kernel replaced."""
    body = next(body for name, body in k40.kernels(ptx) if name.startswith(kernel))
    twin = re.sub(old, new, body, count=1)
    assert twin != body, f"{kernel} holds no {old}"
    return ptx.replace(body, twin)


LOOPS = """
$L1:
mul.rn.f32 %r1,%r2,%r3;
$L2:
mov.f32 %r4,%r5;
fma.rn.f32 %r1,%r2,%r3,%r4;
add.rn.f32 %r1,%r2,%r3;
setp.gt.f32 %r6,%r1,%r2;
@ %r6 bra $L2;
ld.f32 %r7,[%r8];
@ ! %r6 bra $L1;
"""


def check_expected():
    """The K40 on paper: the inner loop's instructions, arithmetic and operations, and what a division becomes."""
    found = []
    if gpu_expected.densest_loop(LOOPS) != (4, 2, 3):
        found.append(f"densest loop: {gpu_expected.densest_loop(LOOPS)}, expected 4 instructions, 2 of them arithmetic, 3 operations")
    if gpu_expected.densest_loop(LOOPS.replace("bra $L2", "bra $L3")) != (7, 3, 4):
        found.append("the twin without the inner loop was not seen")
    single, double = gpu_expected.expansion("div", "f32"), gpu_expected.expansion("div", "f64")
    if not 4 < single < double < 100:
        found.append(f"a division becomes {single} instructions in float, {double} in double")
    return found


def check_text(ptx, fractals):
    found = k40.faults(ptx, fractals)
    march = f"march_{fractals[0]}"
    twins = {
        "fused": changed(ptx, f"{march}_double_exact", r"mul\.rn\.f64 (%r\d+),(%r\d+),(\S+);", r"fma.rn.f64 \1,\2,\3,\2;"),
        "double in a float": changed(ptx, f"{march}_float_fast", r"add\.rn\.f32", "add.rn.f64"),
        "a double's register": changed(ptx, f"{march}_float_exact", r"\.reg \.f32 (%r\d+);", r".reg .f64 \1;"),
        "without .rn": changed(ptx, f"{march}_float_exact", r"mul\.rn\.f32", "mul.f32"),
        "behind a predicate": changed(ptx, f"{march}_float_exact", r"mul\.rn\.f32", "@ ! %r1 mul.f32"),
        "approximate": changed(ptx, f"{march}_float_fast", r"sqrt\.rn\.f32", "sqrt.approx.f32"),
        "flushing": changed(ptx, f"{march}_float_fast", r"add\.rn\.f32", "add.rn.ftz.f32"),
        "another target": ptx.replace(".target sm_35", ".target sm_70"),
        "blocks of an unknown size": re.sub(r"\.maxntid 128, 1, 1\n", "", ptx, count=1),
        "any number of blocks": re.sub(r"\.minnctapersm [47]\n", "", ptx, count=1),
        "any number of marching blocks": re.sub(r"\.minnctapersm 5\n", "", ptx, count=1),
        "a kernel less": ptx.replace(f".entry {march}_float_fast", f".entry {march}_float_quick"),
    }
    for name, twin in twins.items():
        if not k40.faults(twin, fractals):
            found.append(f"the twin '{name}' was not seen")
    return found


def spills(results):
    return [f"{name}: {stack} bytes of stack, {spilled} of spills" for name, (_, stack, spilled) in results.items()
            if stack or spilled]


def check_assembled(ptx, fractals):
    results = k40.assemble(ptx, k40.pinned_ptxas(), "sm_35")
    found = spills(results)
    if len(results) != 12 * len(fractals) + 2:
        found.append(f"{len(results)} kernels assembled, the two of the peak included")
    for name, (registers, _, _) in results.items():
        if k40.PEAK.match(name + "$_omp_fn$0"):
            continue
        kind, _, precision, _ = re.match(k40.KERNEL, name + "$_omp_fn$0").groups()
        most = MORE_REGISTERS.get(name, MOST_REGISTERS[kind, precision])
        if registers > most:
            found.append(f"{name}: {registers} registers, {most} expected at most")
    if not spills(k40.assemble(re.sub(r"\.minnctapersm \d+", ".minnctapersm 16", ptx), k40.pinned_ptxas(), "sm_35")):
        found.append("the twin with 32 registers spills nothing")
    if (k40.k40_threads(32), k40.k40_threads(33), k40.k40_threads(255)) != (2048, 1536, 256):
        found.append("occupancy differs from the occupancy calculator's")
    found += check_expected()
    print(k40.table(ptx), end="")  # assembles it for sm_75 and sm_90 too
    return found


def main():
    check = {"text": check_text, "assemble": check_assembled}[sys.argv[1]]
    texts = k40.extract(sys.argv[2])
    if len(texts) != 1:
        sys.exit(f"{len(texts)} PTX texts in {sys.argv[2]}, expected 1")
    try:
        found = check(texts[0], sys.argv[3:])
    except k40.Unavailable as error:
        print(f"skipped: {error}")
        sys.exit(77)
    for fault in found:
        print("FAILED:", fault)
    sys.exit(bool(found))


main()
