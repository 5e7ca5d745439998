// SPDX-License-Identifier: Apache-2.0
// All programs of the bundle in one executable. The name by which it is called selects the program; if that name is not
// a program's, the first argument does.
#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>

#include "core/text/error.h"
#include "packaging/carried.h"

#define PROGRAM(name) int name##_main(int argc, char** argv);
#include "programs.inc"
#undef PROGRAM

namespace {

struct Program {
    std::string_view name;
    int (*main)(int, char**);
};

constexpr std::array programs{
#define PROGRAM(name) Program{#name, name##_main},
#include "programs.inc"
#undef PROGRAM
};

const Program* find(std::string_view path)
{
    const std::string_view name = path.substr(path.rfind('/') + 1);
    for (const Program& program : programs) {
        if (program.name == name) return &program;
    }
    return nullptr;
}

int usage(bool wanted)
{
    std::FILE* out = wanted ? stdout : stderr;
    std::fputs("mandelmarch PROGRAM [ARGUMENT]...\nprograms:", out);
    for (const Program& program : programs) std::fprintf(out, " %s", program.name.data());
    std::fputs("\n", out);
    return wanted ? mandelmarch::exit_success : mandelmarch::exit_usage;
}

}  // namespace

int main(int argc, char** argv)
{
    const Program* program = argc > 0 ? find(argv[0]) : nullptr;
    if (program == nullptr) {
        if (argc < 2) return usage(false);
        program = find(argv[1]);
        if (program == nullptr) return usage(std::string_view(argv[1]) == "--help");
        --argc;
        ++argv;
        program_invocation_name = argv[0];
    }
    mandelmarch::use_carried(mandelmarch::bundle_folder());
    return program->main(argc, argv);
}
