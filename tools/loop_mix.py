#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""loop_mix.py FOLDER [--table FILE]: counts the instructions of one iteration of the estimators' loop by kind, in
AVX-512 packs and fast mode, and the highest share of the multiply-add peak that they allow. FOLDER has openmp's object
files. A processor with two 512-bit ports starts two such instructions per cycle, of any kind."""
import argparse
import heapq
import os
import re
import subprocess
import sys

from table_file import put

REGISTERS = {"mandelbox": 4, "mandelbulb": 3}  # per pack, as in core/kernel/fractals and backends/openmp/packs/kernel.h
# Instructions per register by which the official scene's path around the loop is recognised: it is the shortest path
# that has these. vrcp14 is the sphere fold's reciprocal. vrsqrt14 are the square roots of x^2 + y^2 and of x^2 + y^2 +
# z^2. vfmsub are the doublings of cosines for the eighth power. vcmp is the escape test.
MARKS = {"mandelbox": {"vrcp14": 1, "vcmp": 1}, "mandelbulb": {"vrsqrt14": 2, "vfmsub": 6, "vcmp": 1}}
LONGEST = 400  # limit of the instructions in a path
KINDS = (
    ("multiply-add", r"vfn?m(add|sub)"),
    ("sum", r"v(add|sub)p"),
    ("product", r"vmulp"),
    ("first bits of 1/x, 1/root", r"v(rcp|rsqrt)14"),
    ("smaller, larger, clip, sign", r"v(min|max|range|and|xor|or)p"),
    ("comparison", r"vcmp"),
    ("choice", r"vblendm|vmovap[sd]\b.*\{%k"),
    ("mask", r"k(and|or|mov|ortest|not|unpck|xor)"),
)
PORTS = 2


def instructions(path):
    """Returns the instructions, as (address, text), of the code that marches in AVX-512 packs without counting work.
    Timed pictures use this code."""
    done = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", path], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"loop_mix: {done.stderr.strip()}")
    found = re.search(r"^[0-9a-f]+ <[^\n]*N_AVX3::[^\n]*::uncounted::wide::take_steps\([^\n]*>:\n(.*?)\n\n", done.stdout + "\n\n", re.M | re.S)
    if found is None:
        sys.exit(f"loop_mix: {path}: no samples in AVX-512 packs")
    lines = (re.match(r"\s*([0-9a-f]+):\s+(.*)", line) for line in found[1].splitlines())
    return [(int(line[1], 16), re.sub(r"\s*#.*", "", line[2]).strip()) for line in lines if line]


def way_round(code, at, start, marks, longest):
    """Returns the shortest path from the instruction `start` back to `start` that contains all of `marks`. Returns None
    if each such path has `longest` or more instructions."""
    wanted = tuple(marks.values())
    first = (start, tuple(0 for _ in marks))
    before = {}
    queue = [(0, *first, None)]
    while queue:
        length, i, met, came = heapq.heappop(queue)
        if length >= longest:
            return None
        if i == start and came is not None and met == wanted:
            way = []
            while came is not None:
                way.append(code[came[0]][1])
                came = before[came]
            return way[::-1]
        if (i, met) in before:
            continue
        before[i, met] = came
        text = code[i][1]
        now = tuple(min(most, n + text.startswith(mark)) for n, (mark, most) in zip(met, marks.items()))
        jump = re.match(r"(j\w+)\s+([0-9a-f]+)", text)
        following = [at[int(jump[2], 16)]] if jump and int(jump[2], 16) in at else []
        if not text.startswith(("ret", "jmp")) and i + 1 < len(code):
            following.append(i + 1)
        for j in following:
            heapq.heappush(queue, (length + 1, j, now, (i, met)))
    return None


def loop(code, marks):
    """Returns the shortest path, around any of the estimators' loops, that contains all of `marks`. These loops are
    recognised by a masked multiply-add, which keeps the values of lanes that have ended."""
    at = {address: i for i, (address, _) in enumerate(code)}
    starts = [i for i, (_, text) in enumerate(code) if re.match(r"vfn?m(add|sub)\w*\s.*\{%k", text)]
    if not starts:
        sys.exit("loop_mix: no masked multiply-add in the loop")
    shortest = None
    for start in starts:
        way = way_round(code, at, start, marks, LONGEST if shortest is None else len(shortest))
        shortest = way or shortest
    if shortest is None:
        sys.exit("loop_mix: no way round the loop has what is looked for")
    return shortest


def mix(way):
    """Returns, by kind, the number of instructions in the path `way`."""
    return {name: sum(re.match(pattern, text) is not None for text in way) for name, pattern in KINDS}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--table")
    args = parser.parse_args()
    columns = {}
    for fractal, marks in MARKS.items():
        marks = {mark: number * REGISTERS[fractal] for mark, number in marks.items()}
        for number in ("float", "double"):
            path = os.path.join(args.folder, f"packs_{fractal}_{number}_fast.cpp.o")
            columns[f"{fractal[6:]}, {number}"] = mix(loop(instructions(path), marks))
    lines = ["loop mix: one iteration of the estimators, AVX-512, fast mode", ""]
    lines.append(f"{'instructions':28}" + "".join(f"{name:>14}" for name in columns))
    registers = [REGISTERS[fractal] for fractal in MARKS for _ in ("float", "double")]
    lines.append(f"{'registers of a pack':28}" + "".join(f"{number:>14}" for number in registers))
    for kind, _ in KINDS:
        lines.append(f"{kind:28}" + "".join(f"{found[kind]:>14}" for found in columns.values()))
    totals = [sum(found.values()) for found in columns.values()]
    lines.append(f"{'all':28}" + "".join(f"{total:>14}" for total in totals))
    lines.append(f"{f'cycles at {PORTS} a cycle':28}" + "".join(f"{total / PORTS:>14.1f}" for total in totals))
    shares = [100 * (2 * found["multiply-add"] + found["sum"] + found["product"]) / (2 * total)
              for found, total in zip(columns.values(), totals)]
    lines.append(f"{'of the peak at most, %':28}" + "".join(f"{share:>14.1f}" for share in shares))
    lines.append("")
    lines.append("The last line: sums and products, a multiply-add for two, over two operations for every instruction, in this loop")
    lines.append("and with every lane at work. First bits take more than one start on some processors, which is not counted.")
    put("\n".join(lines) + "\n", args.table)


if __name__ == "__main__":
    main()
