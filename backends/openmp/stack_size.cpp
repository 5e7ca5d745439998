// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/stack_size.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>

#include "core/base/error.h"

namespace mandelmarch::openmp {
namespace {

constexpr double least = 64;  // min stack size in KiB; a thread needs about 20 KiB

// Returns the size in KiB that a value of OMP_STACKSIZE sets (OpenMP 5.2, 21.2.2): a number, in KiB unless B, K, M or G
// follows. Returns 0 for a value that is not a number, which the run-time library ignores.
double kibibytes(const char* text)
{
    char* rest = nullptr;
    const double number = std::strtod(text, &rest);
    while (std::isspace(static_cast<unsigned char>(*rest)) != 0) ++rest;
    switch (std::tolower(static_cast<unsigned char>(*rest))) {
        case 'b': return number / 1024;
        case 'm': return number * 1024;
        case 'g': return number * 1024 * 1024;
        default: return number;
    }
}

}  // namespace

void check_stack_size()
{
    for (const char* name : {"OMP_STACKSIZE", "GOMP_STACKSIZE"}) {
        const char* text = std::getenv(name);
        const double size = text == nullptr ? 0 : kibibytes(text);
        if (size > 0 && size < least) {
            throw InputError(fmt::format("{}: '{}' given, expected at least {:.0f}K", name, text, least));
        }
    }
}

}  // namespace mandelmarch::openmp
