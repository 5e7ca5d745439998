# SPDX-License-Identifier: Apache-2.0
"""Finds the loops of a march in NVIDIA's machine code or in PTX, and the cycles that a warp takes for an iteration of
each loop. A warp runs on a quarter of a multiprocessor, which issues one instruction of one warp per cycle."""
import re
import subprocess
from collections import namedtuple

# An instruction, or a label of the code. label: the label's name; the other fields are then empty. issue: the number of
# machine instructions that are issued. pipe: the unit that executes the instruction, or None. target: the label to
# which it may jump. falls: true if the next instruction may follow. rare: true if it leads to a slow path that few
# values take.
Instruction = namedtuple("Instruction", "label name issue pipe target falls rare", defaults=("", "", 0, None, "", True, False))

SASS_FUNCTION = re.compile(r"^\.text\.(\S+):$")
SASS_LABEL = re.compile(r"^(\.L_x_\d+|\$\S+):$")
SASS_CODE = re.compile(r"^\s*/\*[0-9a-f]+\*/\s+(@!?U?P\w+\s+)?([A-Z]\S*)\s*(.*?)\s*;")
SASS_PIPES = {
    "double": re.compile(r"D(ADD|MUL|FMA|SETP)$"),
    "special": re.compile(r"(MUFU|F2F|I2F|F2I|FRND)$"),
    "half": re.compile(r"(FSETP|FSEL|FMNMX|SEL|FCHK|ISETP|IADD3|VIADD|IABS|LEA|LOP3|PLOP3|SHF|PRMT|VIMNMX|I2FP|P2R|R2P)$"),
}
PTX_LABEL = re.compile(r"^\s*(\$\S+?):\s*")
PTX_CODE = re.compile(r"^(@\s*!?\s*%\w+\s+)?([a-z]\S*)\s*(.*?);")
PTX_PIPES = {
    "double": re.compile(r"(add|sub|mul|fma|div|sqrt|rcp|setp|min|max)\..*f64$"),
    "special": re.compile(r"(cvt|rcp|sqrt|rsqrt|ex2|lg2)\.(?!.*f64$)"),
}


def pipe_of(name, pipes):
    return next((pipe for pipe, pattern in pipes.items() if pattern.match(name)), None)


def sass(nvdisasm, cubin):
    """Returns the instructions of each function of a cubin."""
    text = subprocess.run([nvdisasm, "-c", cubin], capture_output=True, text=True, check=True).stdout
    functions, code = {}, None
    for line in text.splitlines():
        if found := SASS_FUNCTION.match(line):
            code = functions.setdefault(found[1], [])
        elif re.match(r"\s*\.section", line):
            code = None
        elif code is None:
            continue
        elif found := SASS_LABEL.match(line):
            code.append(Instruction(label=found[1]))
        elif found := SASS_CODE.match(line):
            name = found[2].split(".")[0]
            jump = re.search(r"`\((\S+)\)", found[3]) if name == "BRA" else None
            conditional = bool(found[1]) or bool(re.match(r"!?U?P\d", found[3]))
            code.append(Instruction("", name, 1, pipe_of(name, SASS_PIPES), jump[1] if jump else "",
                                    conditional or name not in ("BRA", "EXIT", "RET"), name == "CALL"))
    return functions


def ptx(body, expansions):
    """Returns the instructions of a PTX kernel's body, except copies. `expansions`: the number of machine instructions
    of each kind of division and square root."""
    code = []
    for line in body.splitlines():
        if found := PTX_LABEL.match(line):
            code.append(Instruction(label=found[1]))
            line = line[found.end():]
        found = PTX_CODE.match(line.strip())
        if not found or found[2].startswith("mov"):
            continue
        word = found[2].split(".")[0]
        name = found[2]
        jumps = word == "bra"
        code.append(Instruction("", name, expansions.get((word, name.rsplit(".", 1)[-1]), 1), pipe_of(name, PTX_PIPES),
                                found[3].strip() if jumps else "", bool(found[1]) or word not in ("bra", "ret", "exit")))
    return code


def blocks_of(code):
    """Returns two lists with an entry for each basic block: its instructions, and the indices of the blocks that may
    follow it."""
    blocks, labels, current = [], {}, []
    for one in [*code, Instruction(label="end")]:
        if current and (one.label or current[-1].target or not current[-1].falls or current[-1].rare):
            blocks.append(current)
            current = []
        if one.label:
            labels[one.label] = len(blocks)
        else:
            current.append(one)
    following = []
    for i, block in enumerate(blocks):
        last = block[-1]
        to = [labels[last.target]] if last.target in labels else []
        following.append([j for j in to + [i + 1] * last.falls if j < len(blocks)])
    return blocks, following


def loops_of(following):
    """Returns the natural loops (Aho, Sethi and Ullman, "Compilers", 1986, 10.4): for each loop's head, the set of the
    loop's blocks. `following`: for each block, the blocks that may follow it."""
    before = [[] for _ in following]
    for i, after in enumerate(following):
        for j in after:
            before[j].append(i)
    everything = set(range(len(following)))
    dominators = [{0}] + [everything] * (len(following) - 1)
    changed = True
    while changed:
        changed = False
        for i in range(1, len(following)):
            now = {i} | (set.intersection(*(dominators[j] for j in before[i])) if before[i] else set())
            changed = changed or now != dominators[i]
            dominators[i] = now
    loops = {}
    for i, after in enumerate(following):
        for head in set(after) & dominators[i]:
            body, waiting = loops.setdefault(head, {head}), [i]
            while waiting:
                block = waiting.pop()
                if block not in body:
                    body.add(block)
                    waiting += before[block]
    return loops


def cycles(instructions, cycles_of_pipe):
    """Returns the cycles that a warp's instructions take: the larger of the cycles in which they are issued and the
    cycles of the busiest pipe."""
    busy = {}
    for one in instructions:
        busy[one.pipe] = busy.get(one.pipe, 0) + one.issue * cycles_of_pipe.get(one.pipe, 1)
    return max(sum(one.issue for one in instructions), *busy.values(), 0)


# Cycles and instructions of a march. The fields round_* are for an iteration of the estimator's loop, and step_* for
# the rest of a step of the march. refills: true if lanes take new rays before the last ray of their warp has ended.
March = namedtuple("March", "round_cycles step_cycles round_instructions step_instructions refills")
LEAST_ARITHMETIC = 0.2  # fraction of a loop's instructions that must be arithmetic
ARITHMETIC = re.compile(r"[FD](ADD|MUL|FMA)$|(add|sub|mul|fma|div|sqrt)\..*f(32|64)$")


def march_of(code, cycles_of_pipe, loops_outside=0):
    """Returns the March of a kernel's code. The estimator's loop is the shortest innermost loop that contains
    arithmetic and lies within another loop. For the Mandelbulb, it is the loop for integer powers. The march's loop is
    the smallest loop around the estimator's; all its paths but slow ones count. `loops_outside`: the number of loops
    that every kernel has around the march of a pixel. If there are more, lanes refill."""
    blocks, following = blocks_of(code)
    loops = loops_of(following)

    def instructions(numbers):
        return [one for i in numbers if not any(one.rare for one in blocks[i]) for one in blocks[i]]

    def share(body):
        inside = instructions(body)
        return sum(bool(ARITHMETIC.match(one.name)) for one in inside) / len(inside)

    inner = [body for body in loops.values() if any(body < other for other in loops.values())
             and not any(other < body for other in loops.values())]
    estimators = [body for body in inner if share(body) > LEAST_ARITHMETIC]
    if not estimators:
        raise ValueError("no loop that computes within another one")
    estimator = min(estimators, key=lambda body: len(instructions(body)))
    around = sorted((body for body in loops.values() if estimator < body), key=len)
    beside = around[0].difference(*(body for body in inner if body < around[0]))
    once, step = instructions(estimator), instructions(beside)
    return March(cycles(once, cycles_of_pipe), cycles(step, cycles_of_pipe), sum(one.issue for one in once),
                 sum(one.issue for one in step), len(around) > 1 + loops_outside)
