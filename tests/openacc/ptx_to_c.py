# SPDX-License-Identifier: Apache-2.0
"""ptx_to_c.py gcc|nvcc PROGRAM: translates to C the PTX that gcc or nvcc has put into a built program. The C runs the
PTX on a machine without a GPU, one thread after the other. Supports only the instructions of this project's kernels;
any other instruction is an error."""
import os
import re
import sys

sys.dont_write_bytecode = True
import device_code  # noqa: E402

C_TYPES = {"u16": "uint16_t", "s16": "int16_t", "u32": "uint32_t", "s32": "int32_t", "b32": "uint32_t", "u64": "uint64_t",
           "s64": "int64_t", "b64": "uint64_t", "f32": "float", "f64": "double", "pred": "bool", "u8": "uint8_t", "b16": "uint16_t"}
COMPARISONS = {"eq": "==", "ne": "!=", "neu": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}
UNORDERED = {"ltu": ">=", "leu": ">", "gtu": "<=", "geu": "<"}  # the opposites, to be negated: true for NaN
INFIX = {"xor": "^", "add": "+", "sub": "-", "mul": "*", "div": "/", "rem": "%", "and": "&", "or": "|"}
SPECIAL = {"%tid.x": "tid", "%ctaid.x": "ctaid", "%nctaid.x": "nctaid", "%ntid.x": "threads_of_block"}
NVCC_ENTRY = re.compile(r"^\.visible \.entry (mandelmarch_cuda_(?:cones|march|shade|bytes)_\w+)\([^)]*\)\s*\{(.*?)^\}", re.M | re.S)
LINE = re.compile(r"(?:@\s*(!?)\s*(%\w+)\s+)?([a-z][\w.]*)\s*(.*?);$")

HEADER = """#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
// A function whose calls are not counted.
#define OWN static __attribute__((no_instrument_function))
static uint64_t broadcast[64];  // shared memory
static unsigned threads_of_block;  // of a launch
OWN double f64_of(uint64_t bits) { double f; memcpy(&f, &bits, 8); return f; }
OWN float f32_of(uint32_t bits) { float f; memcpy(&f, &bits, 4); return f; }
OWN int32_t s32_of(double a) { return a != a ? 0 : a >= 0x1p31 ? INT32_MAX : a < -0x1p31 ? INT32_MIN : (int32_t)a; }
OWN int64_t s64_of(double a) { return a != a ? INT64_MIN : a >= 0x1p63 ? INT64_MAX : a < -0x1p63 ? INT64_MIN : (int64_t)a; }
// Max and min as in PTX: if one operand is NaN, the result is the other one; +0 is larger than -0.
OWN double larger(double a, double b) { return a != a ? b : b != b ? a : a > b ? a : b > a ? b : signbit(a) ? b : a; }
OWN double smaller(double a, double b) { return a != a ? b : b != b ? a : a < b ? a : b < a ? b : signbit(a) ? a : b; }
// The suffix .ftz: subnormal numbers become zero.
OWN float flushed(float a) { return fabsf(a) < 0x1p-126f ? copysignf(0, a) : a; }
// Approximate operations of GPUs differ. Here their results are one unit in the last place too large or too small.
OWN float approximate(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, 4);
    return a == 0 || !isfinite(a) ? a : flushed(nextafterf(a, bits * 2654435769u >> 31 ? INFINITY : -INFINITY));
}
"""


class Kernel:
    def __init__(self, name, body):
        self.name = name
        self.types = {}
        self.lines = [line.strip() for line in body.split("\n")]
        for line in self.lines:
            if declared := re.match(r"\.reg \.(\w+) %(\w+);", line):
                self.types[declared[2]] = declared[1]
        for kind, prefix, number in re.findall(r"\.reg \.(\w+)\s+%(\w+)<(\d+)>;", body):
            self.types |= {f"{prefix}{i}": kind for i in range(int(number))}

    def value(self, operand, kind):
        """Returns the C expression of an operand, as a number of this kind."""
        operand = operand.strip()
        if operand in SPECIAL:
            return SPECIAL[operand]
        if operand.startswith("%"):
            return f"(({C_TYPES[kind]}){operand[1:]})"
        if operand[:2] in ("0d", "0f"):
            return f"f64_of(0x{operand[2:]}ull)" if operand[1] == "d" else f"f32_of(0x{operand[2:]}u)"
        if operand == "__oacc_bcast":
            return "(uint64_t)broadcast"
        return f"(({C_TYPES[kind]}){int(operand, 0)}ll)"

    def address(self, operand):
        register, offset = re.match(r"\s*\[%(\w+)([+-]\d+)?\]", operand.replace("+-", "-")).groups()
        return f"(void*)({register}{offset or ''})"

    def operation(self, word, suffixes, operands):
        if word in ("ld", "st") and any(suffix in ("v2", "v4") for suffix in suffixes):
            return self.vector_operation(word, suffixes[-1], operands)
        kind = suffixes[-1] if suffixes else None
        if word in ("bar", "barrier"):
            return ""  # the first thread runs to its end before the others begin
        if word == "bra":
            return f"goto {operands[0].strip().replace('$', '')};"
        if word == "ret":
            return "return;"
        if word == "st":
            return f"*({C_TYPES[kind]}*){self.address(operands[0])} = {self.value(operands[1], kind)};"
        to = operands[0].strip().lstrip("%")
        rest = operands[1:]
        if word == "ld":
            if suffixes[0] == "param":
                return f"{to} = argument;"
            return f"{to} = *({C_TYPES[kind]}*){self.address(rest[0])};"
        if word == "atom":
            place = f"*({C_TYPES[kind]}*){self.address(rest[0])}"
            return f"{to} = {place}; {place} += {self.value(rest[1], kind)};"
        if word == "mov" and rest[0].strip().startswith("%") and kind.startswith("b"):
            return f"memcpy(&{to}, &{rest[0].strip()[1:]}, {int(kind[1:]) // 8});"
        return f"{to} = {self.result(word, suffixes, kind, rest)};"

    def vector_operation(self, word, kind, operands):
        vector, memory = operands if word == "ld" else reversed(operands)
        out = []
        for i, part in enumerate(vector.strip().strip("{}").split(",")):
            place = f"(({C_TYPES[kind]}*){self.address(memory)})[{i}]"
            value = self.value(part, kind)
            out.append(f"{part.strip()[1:]} = {place};" if word == "ld" else f"{place} = {value};")
        return " ".join(out)

    def result(self, word, suffixes, kind, rest):
        if word in ("mov", "cvta"):
            return self.value(rest[0], kind)
        if word == "cvt":
            a = self.value(rest[0], kind)
            if suffixes[0] == "rni":
                return f"nearbyint({a})"
            if suffixes[0] == "rzi":
                return f"{suffixes[1]}_of({a})"
            return f"({C_TYPES[suffixes[-2]]}){a}"
        if word == "setp" and suffixes[0] in UNORDERED:
            return f"!({self.value(rest[0], kind)} {UNORDERED[suffixes[0]]} {self.value(rest[1], kind)})"
        if word == "setp":
            return f"{self.value(rest[0], kind)} {COMPARISONS[suffixes[0]]} {self.value(rest[1], kind)}"
        if word == "selp":
            return f"{self.value(rest[2], 'pred')} ? {self.value(rest[0], kind)} : {self.value(rest[1], kind)}"
        if word in ("vadd", "vsub"):
            sign = "+" if word == "vadd" else "-"
            a, b, c = (self.value(operand, "u32") for operand in rest)
            return f"{a} {sign} {b} + {c}"
        values = [self.value(operand, kind) for operand in rest]
        if word == "mul" and "wide" in suffixes:
            wide = {"s32": "int64_t", "u32": "uint64_t"}[kind]
            return f"({wide}){values[0]} * ({wide}){values[1]}"
        if word in ("min", "max") and kind in ("f32", "f64"):
            return f"{'smaller' if word == 'min' else 'larger'}({values[0]}, {values[1]})"
        if "approx" in suffixes:
            return f"approximate({self.approximated(word, *(f'flushed({value})' for value in values))})"
        if word in INFIX:
            return f"{values[0]} {INFIX[word]} {values[1]}"
        by_word = {"mad": "{0} * {1} + {2}", "fma": "FMA({0}, {1}, {2})", "neg": "-{0}", "abs": "FABS({0})",
                   "not": "!{0}" if kind == "pred" else "~{0}", "sqrt": "SQRT({0})", "rcp": "1 / {0}",
                   "min": "{0} < {1} ? {0} : {1}"}
        if word in ("shl", "shr"):
            count = self.value(rest[1], "u32")
            bits = int(kind[1:])
            shift = f"{values[0]} {'<<' if word == 'shl' else '>>'}"
            if kind[0] == "s":
                return f"{shift} ({count} < {bits} ? {count} : {bits - 1})"
            return f"{count} < {bits} ? {shift} {count} : 0"
        end = "f" if kind == "f32" else ""
        text = by_word[word].replace("FMA", "fma" + end).replace("FABS", "fabs" + end).replace("SQRT", "sqrt" + end)
        return text.format(*values)

    def approximated(self, word, a, b=None):
        return {"div": f"{a} / {b}", "rcp": f"1 / {a}", "sqrt": f"sqrtf({a})", "rsqrt": f"1 / sqrtf({a})", "lg2": f"log2f({a})"}[word]

    def c_text(self):
        out = [f"OWN void {self.c_name()}(uint64_t argument, uint32_t tid, uint32_t ctaid, uint32_t nctaid)\n{{"]
        out += [f"{C_TYPES[kind]} {name};" for name, kind in self.types.items()]
        for line in self.lines:
            line = line.split("//")[0].strip()
            if not line or line.startswith(".") or line in ("{", "}"):
                continue
            if label := re.match(r"\$(\w+):$", line):
                out.append(f"{label[1]}:;")
                continue
            negated, predicate, instruction, operands = LINE.match(line).groups()
            word, *suffixes = instruction.split(".")
            parts = re.findall(r"\{[^}]*\}|\[[^]]*\]|[^,{\[]+", operands)
            text = self.operation(word, suffixes, [part.strip() for part in parts if part.strip()])
            out.append(f"if ({negated}{predicate[1:]}) {{ {text} }}" if predicate else text)
        return "\n".join(out + ["}"])

    def c_name(self):
        return self.name.replace("$", "_")


def translate(kernels):
    """Returns a C source with all kernels and a table of the kernels by name."""
    parsed = [Kernel(name, body) for name, body in kernels]
    table = "".join(f'{{"{kernel.name}", {kernel.c_name()}}},\n' for kernel in parsed)
    return (HEADER + "\n".join(kernel.c_text() for kernel in parsed) +
            "\nstatic const struct { const char* name; void (*run)(uint64_t, uint32_t, uint32_t, uint32_t); } kernels[] = {\n" +
            table + "};\n")


def main():
    compiler, program = sys.argv[1:]
    if compiler == "gcc":
        kernels = device_code.kernels(device_code.extract(program)[0])
    else:
        kernels = [kernel for text in device_code.extract_cuda(program) for kernel in NVCC_ENTRY.findall(text)]
    print(translate(kernels))


main()
