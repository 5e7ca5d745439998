# SPDX-License-Identifier: Apache-2.0
"""ptx_to_c.py gcc|nvcc PROGRAM: translates to C the PTX that gcc or nvcc has put into a built program. The C runs the
PTX on a machine without a GPU (simulated_cuda.c), one warp after the other. Supports only the instructions of this project's kernels;
any other instruction is an error. ptx_test.py imports the functions that find the PTX."""
import re
import sys

C_TYPES = {"u16": "uint16_t", "s16": "int16_t", "u32": "uint32_t", "s32": "int32_t", "b32": "uint32_t", "u64": "uint64_t",
           "s64": "int64_t", "b64": "uint64_t", "f32": "float", "f64": "double", "pred": "bool", "u8": "uint8_t", "b16": "uint16_t"}
COMPARISONS = {"eq": "==", "ne": "!=", "neu": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">="}
UNORDERED = {"ltu": ">=", "leu": ">", "gtu": "<=", "geu": "<"}  # the opposites, to be negated: true for NaN
INFIX = {"xor": "^", "add": "+", "sub": "-", "mul": "*", "div": "/", "rem": "%", "and": "&", "or": "|"}
SPECIAL = {"%tid.x": "tid", "%tid.y": "tid_y", "%ctaid.x": "ctaid", "%nctaid.x": "nctaid", "%ntid.x": "threads_of_block",
           "%lanemask_lt": "((1u << tid % 32) - 1)"}
NVCC_ENTRY = re.compile(r"^\.visible \.entry (mandelmarch_cuda_(?:cones|draw)_\w+)\([^)]*\)\s*(?:\.\w+ [\d, ]+\s*)*\{(.*?)^\}", re.M | re.S)
KERNEL = re.compile(r"(cones|draw)_(\w+)_(float|double)_(exact|fast)\$_omp_fn\$0$")
PEAK = re.compile(r"multiply_adds_(float|double)\$_omp_fn\$0$")  # measures the device's peak with fused operations
# The final brace excludes declarations, which end with a semicolon.
ENTRY = re.compile(r"^\.entry (\S+) \([^)]*\)\s*(?:\.(?:maxntid|minnctapersm) [\d, ]+\s*)*\{", re.M)
GLOBAL = re.compile(r"^\.visible \.global \.align (\d+) \.(\w+) (\w+)\[(\d+)\];", re.M)  # a variable in device memory
LINE = re.compile(r"(?:@\s*(!?)\s*(%\w+)\s+)?([a-z][\w.]*)\s*(.*?);$")

HEADER = """#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
static uint64_t shared[4096];  // a block's shared memory
static unsigned threads_of_block;  // of a launch
// Operations of a warp, which all its lanes call together: of_lane() returns the value of one lane.
static uint32_t of_lane(uint32_t value, uint32_t lane);
static uint32_t ballot(bool on);
static double f64_of(uint64_t bits) { double f; memcpy(&f, &bits, 8); return f; }
static float f32_of(uint32_t bits) { float f; memcpy(&f, &bits, 4); return f; }
static int32_t s32_of(double a) { return a != a ? 0 : a >= 0x1p31 ? INT32_MAX : a < -0x1p31 ? INT32_MIN : (int32_t)a; }
static int64_t s64_of(double a) { return a != a ? INT64_MIN : a >= 0x1p63 ? INT64_MAX : a < -0x1p63 ? INT64_MIN : (int64_t)a; }
// Max and min as in PTX: if one operand is NaN, the result is the other one; +0 is larger than -0.
static double larger(double a, double b) { return a != a ? b : b != b ? a : a > b ? a : b > a ? b : signbit(a) ? b : a; }
static double smaller(double a, double b) { return a != a ? b : b != b ? a : a < b ? a : b < a ? b : signbit(a) ? a : b; }
// The suffix .ftz: subnormal numbers become zero.
static float flushed(float a) { return fabsf(a) < 0x1p-126f ? copysignf(0, a) : a; }
// In double, approximations have 20 bits.
static double upper_half(double a) { uint64_t bits; memcpy(&bits, &a, 8); return f64_of(bits >> 32 << 32); }
// Approximate operations of GPUs differ. Here their results are one unit in the last place too large or too small.
static float approximate(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, 4);
    return a == 0 || !isfinite(a) ? a : flushed(nextafterf(a, bits * 2654435769u >> 31 ? INFINITY : -INFINITY));
}
"""


def extract(program):
    """Returns the PTX modules with OpenACC's kernels in a program's file. Each is a string that begins with a
    preamble."""
    with open(program, "rb") as file:
        data = file.read()
    texts = [text.decode("ascii") for text in re.findall(rb"// BEGIN PREAMBLE\n\.version[^\0]*", data)]
    return [text for text in texts if any(KERNEL.match(name) or PEAK.match(name) for name, _ in kernels(text))]


def extract_cuda(program):
    """Returns nvcc's PTX modules in a program's file, one per fractal, precision and mode. A build without cuda has
    none."""
    with open(program, "rb") as file:
        texts = re.findall(rb"\n\.version [^\0]*", file.read())
    return [text.decode("ascii") for text in texts if b".entry mandelmarch_cuda_" in text]


def kernels(ptx):
    """Returns the names and bodies of the kernels. A body may contain blocks in braces."""
    found = []
    for entry in ENTRY.finditer(ptx):
        depth = 1
        for brace in re.finditer(r"[{}]", ptx[entry.end():]):
            depth += 1 if brace[0] == "{" else -1
            if depth == 0:
                found.append((entry[1], ptx[entry.end():entry.end() + brace.start()]))
                break
    return found


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
            return "(uint64_t)shared"
        if operand.startswith(("slots_", "marched_")):
            return f"(uint64_t){operand}"
        if operand[0].isalpha() or operand[0] == "_":
            return "0"  # where nvcc's argument and shared memory begin
        return f"(({C_TYPES[kind]}){int(operand, 0)}ll)"

    def address(self, operand, space):
        """Returns the C expression of an address. nvcc's addresses in shared memory have 32 bits and begin at 0."""
        name, offset = re.match(r"\s*\[%?([\w$]+)([+-]\d+)?\]", operand.replace("+-", "-")).groups()
        register = self.types.get(name)
        if not operand.strip().startswith("[%") and space != "param":
            return f"(void*)({self.value(name, 'u64')} + {offset or 0})"
        start = "argument" if space == "param" else "(uint64_t)shared" if register in ("b32", "u32") else "0"
        return f"(void*)({start} + {name if register else 0}{offset or ''})"

    def operation(self, word, suffixes, operands):
        if word in ("ld", "st") and any(suffix in ("v2", "v4") for suffix in suffixes):
            return self.vector_operation(word, suffixes, operands)
        kind = suffixes[-1] if suffixes else None
        if word == "bar" and suffixes[0] == "warp":
            return "of_lane(0, 0);"
        if word in ("bar", "barrier"):
            return ""  # the first warp runs to its end before the others begin
        if word == "bra":
            return f"goto {operands[0].strip().replace('$', '')};"
        if word == "ret":
            return "return;"
        if word == "st":
            return f"*({C_TYPES[kind]}*){self.address(operands[0], suffixes[0])} = {self.value(operands[1], kind)};"
        to = operands[0].strip().lstrip("%")
        rest = operands[1:]
        if word == "ld":
            return f"{to} = *({C_TYPES[kind]}*){self.address(rest[0], suffixes[0])};"
        if word == "atom":
            place = f"*({C_TYPES[kind]}*){self.address(rest[0], suffixes[0])}"
            return f"{to} = {place}; {place} += {self.value(rest[1], kind)};"
        if word == "mov" and "{" in operands[0] + operands[1]:
            return self.halves(*operands)
        if word == "mov" and rest[0].strip().startswith("%") and kind.startswith("b"):
            return f"memcpy(&{to}, &{rest[0].strip()[1:]}, {int(kind[1:]) // 8});"
        return f"{to} = {self.result(word, suffixes, kind, rest)};"

    def halves(self, to, source):
        """Returns the C that copies a register of 64 bits to two of 32 bits, or the other way round."""
        low, high = (part.strip()[1:] for part in (to if "{" in to else source).strip("{}").split(","))
        if "{" in to:
            return f"uint64_t all; memcpy(&all, &{source[1:]}, 8); {low} = (uint32_t)all; {high} = all >> 32;"
        return f"const uint64_t all = (uint64_t){high} << 32 | {low}; memcpy(&{to[1:]}, &all, 8);"

    def vector_operation(self, word, suffixes, operands):
        kind = suffixes[-1]
        vector, memory = operands if word == "ld" else reversed(operands)
        out = []
        for i, part in enumerate(vector.strip().strip("{}").split(",")):
            place = f"(({C_TYPES[kind]}*){self.address(memory, suffixes[0])})[{i}]"
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
        if word == "testp":
            return f"isnormal({self.value(rest[0], kind)})"
        if word == "vote":
            return f"ballot({self.value(rest[0], 'pred')})"
        if word == "shfl":
            return f"of_lane({self.value(rest[0], kind)}, {self.value(rest[1], 'u32')})"
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
        if "approx" in suffixes and kind == "f64":
            return f"upper_half({self.approximated(word, *values).replace('sqrtf', 'sqrt')})"
        if "approx" in suffixes:
            return f"approximate({self.approximated(word, *(f'flushed({value})' for value in values))})"
        if word in INFIX:
            return f"{values[0]} {INFIX[word]} {values[1]}"
        by_word = {"mad": "{0} * {1} + {2}", "fma": "FMA({0}, {1}, {2})", "neg": "-{0}", "abs": "FABS({0})", "popc": "__builtin_popcount({0})",
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
        out = [f"static void {self.c_name()}(uint64_t argument, uint32_t tid, uint32_t tid_y, uint32_t ctaid, uint32_t nctaid)\n{{"]
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
            out.append(f"{f'if ({negated}{predicate[1:]}) ' if predicate else ''}{{ {text} }}")
        return "\n".join(out + ["}"])

    def c_name(self):
        return self.name.replace("$", "_")


def translate(named_bodies, variables):
    """Returns a C source with all kernels, the variables in device memory, and tables of both by name."""
    parsed = [Kernel(name, body) for name, body in named_bodies]
    table = "".join(f'{{"{kernel.name}", {kernel.c_name()}}},\n' for kernel in parsed)
    named = "".join(f'{{"{name}", {name}, sizeof {name}}},\n' for _, _, name, _ in variables)
    return (HEADER + "".join(f"static {C_TYPES[kind]} {name}[{size}] __attribute__((aligned({alignment})));\n"
                             for alignment, kind, name, size in variables) + "\n".join(kernel.c_text() for kernel in parsed) +
            "\nstatic const struct { const char* name; void (*run)(uint64_t, uint32_t, uint32_t, uint32_t, uint32_t); } kernels[] = {\n" +
            table + "};\nstatic const struct { const char* name; void* at; uint64_t bytes; } variables[] = {\n" + named + "{0}};\n")


def main():
    compiler, program = sys.argv[1:]
    if compiler == "gcc":
        ptx = extract(program)[0]
        print(translate(kernels(ptx), GLOBAL.findall(ptx)))
    else:
        print(translate([kernel for text in extract_cuda(program) for kernel in NVCC_ENTRY.findall(text)], []))


if __name__ == "__main__":
    main()
