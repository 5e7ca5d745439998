#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gpu_expected.py PROGRAM ROWS.json LANES.json... [--gpu K40|H200] [--table FILE]: the time that a frame of 1920 x 1080 should take
on a GPU, from its data sheet, the operations that bench counted for that size (ROWS), the lanes it found active (LANES, of the
study box-vs-bulb in both modes) and the code that NVIDIA's assembler makes of the built program for sm_35, a newer GPU's, too."""
import argparse
import json
import os
import re
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import k40
from table_file import put

# Peaks in operations a second, and clocks of all multiprocessors.
GPUS = {
    # NVIDIA, "Tesla K40 GPU Active Accelerator", board specification, 2013: 15 multiprocessors at 745 MHz; 4.29 and 1.43
    # TFLOP/s.
    "K40": ({"float": 4.29e12, "double": 1.43e12}, 15 * 745e6),
    # NVIDIA, "H200 Tensor Core GPU", data sheet, 2024: 67 and 34 TFLOP/s; "NVIDIA H100 Tensor Core GPU Architecture", white
    # paper, 2022: 132 multiprocessors, and the 1.98 GHz that make these peaks.
    "H200": ({"float": 67e12, "double": 34e12}, 132 * 1.98e9),
}
# A multiprocessor has four schedulers, each a warp of 32 an instruction a clock, and 64 lanes for double: of Kepler
# ("NVIDIA Kepler GK110", white paper, 2012; a second instruction a clock is not counted on) and of Hopper (as above).
ISSUE_LANES = 4 * 32
DOUBLE_LANES = 64
ARITHMETIC = {"add": 1, "sub": 1, "mul": 1, "fma": 2, "div": 1, "sqrt": 1}  # operations as bench counts them


def code_sizes(cubin):
    """Instructions per function of an sm_35 cubin: 8 bytes each, and one word in eight tells the scheduler."""
    at, = struct.unpack_from("<Q", cubin, 40)
    entry, count, names = struct.unpack_from("<HHH", cubin, 58)
    sections = [struct.unpack_from("<IIQQQQ", cubin, at + i * entry) for i in range(count)]
    strings = sections[names][4]
    sizes = {}
    for name, _, _, _, _, size in sections:
        text = cubin[strings + name:cubin.index(b"\0", strings + name)].decode()
        if text.startswith(".text."):
            sizes[text.removeprefix(".text.").removesuffix("$_omp_fn$0")] = size // 8 * 7 // 8
    return sizes


def assembled(ptx):
    with tempfile.TemporaryDirectory() as folder:
        source, target = os.path.join(folder, "a.ptx"), os.path.join(folder, "a.cubin")
        with open(source, "w", encoding="utf-8") as file:
            file.write(ptx)
        subprocess.run([k40.pinned_ptxas(), "-arch=sm_35", source, "-o", target], check=True, capture_output=True)
        with open(target, "rb") as file:
            return code_sizes(file.read())


def expansion(operation, suffix):
    """Instructions that one division or root becomes. Each takes its own beside the first, or all call the first's."""
    def kernel(times):
        steps = "".join(f"{operation}.rn.{suffix} %a, {'%a, %b' if operation == 'div' else '%a'};\n" for _ in range(times))
        text = (f".version 3.1\n.target sm_35\n.address_size 64\n.visible .entry k(.param .u64 p) {{\n.reg .u64 %p;\n"
                f".reg .{suffix} %a, %b;\nld.param.u64 %p, [p];\nld.global.{suffix} %a, [%p];\nld.global.{suffix} %b, [%p+8];\n"
                f"{steps}st.global.{suffix} [%p], %a;\nret;\n}}\n")
        return assembled(text)["k"]
    each = (kernel(41) - kernel(1)) / 40
    return each if each > 2 else kernel(1) - kernel(0)


def densest_loop(body):
    """Instructions (copies apart), arithmetic ones and operations of the loop with the largest share of arithmetic: the
    distance estimator's."""
    code, labels, loops = [], {}, []
    for line in body.splitlines():
        label = re.match(r"\s*(\$L\d+):", line)
        if label:
            labels[label[1]] = len(code)
            line = line[label.end():]
        line = re.sub(r"^\s*@\s*!?\s*%\w+\s+", "", line).strip()
        if line and line[0] not in ".{}/":
            code.append(line)
    for i, line in enumerate(code):
        jump = re.match(r"bra(?:\.uni)?\s+(\$L\d+)", line)
        if jump and labels.get(jump[1], len(code)) <= i:
            names = [line.split()[0].split(".") for line in code[labels[jump[1]]:i + 1]]
            arithmetic = [n[0] for n in names if n[0] in ARITHMETIC and n[-1] in ("f32", "f64")]
            instructions = sum(n[0] != "mov" for n in names)
            loops.append((len(arithmetic) / instructions, instructions, len(arithmetic), sum(ARITHMETIC[n] for n in arithmetic)))
    return max(loops)[1:]


def active_lanes(count):
    """Of 32 lanes; files of older builds know 16 only, that go on together."""
    for use in count.get("lane_use", []):
        if use["lanes"] == 32:
            return use["active_in_iterations"], use["refilled_active_in_iterations"]
    return count["active_in_iterations"], None


def costs(ptx, counts):
    """Per fractal, precision and mode: instructions an operation, those of the floating-point lanes, and the shares of a
    warp's lanes that are active: together, and refilled. Divisions and roots come in the shares that bench counted, the
    others in the loop's mix."""
    weight = {(o, s): expansion(o, s) for o in ("div", "sqrt") for s in ("f32", "f64")}
    found = {}
    for name, body in k40.kernels(ptx):
        match = k40.KERNEL.match(name)
        if not match or match[1] != "march" or match.groups()[1:] not in counts:
            continue
        count = counts[match.groups()[1:]]
        total = {k: sum(stage[k] for stage in count["stages"].values()) for k in ("sums", "products", "quotients", "roots")}
        suffix = "f32" if match[3] == "float" else "f64"
        shares = [(total["quotients"] / sum(total.values()), weight["div", suffix]),
                  (total["roots"] / sum(total.values()), weight["sqrt", suffix])]
        plain = 1 - sum(share for share, _ in shares)
        expanded = sum(share * instructions for share, instructions in shares)
        instructions, arithmetic, operations = densest_loop(body)
        found[match.groups()[1:]] = (plain * instructions / operations + expanded, plain * arithmetic / operations + expanded,
                                     *active_lanes(count))
    return found, weight


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        sys.exit(f"gpu_expected: {path}: {error}, expected a result of bench")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("rows")
    parser.add_argument("lanes", nargs="+")
    parser.add_argument("--gpu", choices=GPUS, default="K40")
    parser.add_argument("--table")
    arguments = parser.parse_args()
    ptx = k40.extract(arguments.program)
    if len(ptx) != 1:
        sys.exit(f"gpu_expected: {arguments.program} holds {len(ptx)} texts of PTX, expected one")
    counts = {(c["fractal"], c["precision"], c["mode"]): c for path in arguments.lanes for c in read(path)["counts"]
              if c["setting"]["view"] == "official"}
    try:
        kernels, weight = costs(ptx[0], counts)
    except k40.Unavailable as error:
        sys.exit(f"gpu_expected: {error}")
    peak, clocks_a_second = GPUS[arguments.gpu]
    lines = [f"{arguments.gpu} on paper, 1920 x 1080, kernel time; "
             + ", ".join(f"{o}.{s}: {w:.1f} instructions" for (o, s), w in weight.items()),
             f"{'fractal':<12}{'number':<8}{'mode':<7}{'operations':>11}{'at the':>9}{'instructions':>14}{'lanes':>8}{'expected':>10}"
             f"{'share of':>10}{'refilled':>10}{'expected':>10}",
             f"{'':<27}{'a pixel':>11}{'peak, ms':>9}{'an operation':>14}{'active':>8}{'ms':>10}{'peak':>10}{'lanes':>10}{'ms':>10}"]
    for row in read(arguments.rows)["rows"]:
        key = row["fractal"], row["precision"], row["mode"]
        setting = row["setting"]
        if row["backend"] != "openacc" or not row["figures"] or key not in kernels or (setting["width"], setting["height"]) != (1920, 1080):
            continue
        instructions, arithmetic, lanes, refilled = kernels[key]
        clocks = instructions / ISSUE_LANES if key[1] == "float" else max(instructions / ISSUE_LANES, arithmetic / DOUBLE_LANES)
        bound = row["operations"] / peak[key[1]]
        seconds = row["operations"] * clocks / clocks_a_second / lanes
        lines.append(f"{key[0]:<12}{key[1]:<8}{key[2]:<7}{row['operations'] / (1920 * 1080):>11.0f}{1e3 * bound:>9.3g}"
                     f"{instructions:>14.2f}{lanes:>8.0%}{1e3 * seconds:>10.3g}{bound / seconds:>10.1%}"
                     + (f"{'-':>10}{'-':>10}" if refilled is None else f"{refilled:>10.0%}{1e3 * seconds * lanes / refilled:>10.3g}"))
    if len(lines) == 3:
        sys.exit(f"gpu_expected: {arguments.rows} has no rows of openacc at 1920 x 1080")
    put("\n".join(lines) + "\n", arguments.table)


if __name__ == "__main__":
    main()
