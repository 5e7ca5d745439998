// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/instructions.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <cstdlib>

#include "core/base/error.h"

namespace mandelmarch::openmp {

std::string usual_name(std::string_view highway)
{
    constexpr std::string_view avx3 = "AVX3";
    if (!highway.starts_with(avx3)) return std::string(highway);
    return fmt::format("AVX-512{}", highway.substr(avx3.size()));
}

std::int64_t instructions()
{
    const std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS;
    const char* wanted = std::getenv("MANDELMARCH_INSTRUCTIONS");
    if (wanted == nullptr || *wanted == '\0') return all;
    std::string known;
    for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        const std::string_view highway = hwy::TargetName(target);
        const std::string name = usual_name(highway);
        if (name == wanted || highway == wanted) return target;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
    }
    throw InputError(
        fmt::format("MANDELMARCH_INSTRUCTIONS: '{}' given, expected one of {} on this machine", wanted, known));
}

}  // namespace mandelmarch::openmp
