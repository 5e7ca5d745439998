// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/variants.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include "core/text/environment.h"
#include "core/text/error.h"

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
    const std::string wanted = environment_variable("MANDELMARCH_INSTRUCTIONS");
    if (wanted.empty()) return all;
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

template <class Real>
std::vector<Variant<Real>> variants_of(std::string_view fractal, Mode mode, std::int64_t targets)
{
    const std::string name = variant_name(fractal, precision_of<Real>, mode);
    const Variant<Real>* scalar = scalar_variant<Real>(name);
    if (scalar == nullptr) throw Unavailable(fmt::format("backend openmp: it does not draw the {}", fractal));
    const VariantList<Real> packs = pack_variants<Real>(name)(targets);
    std::vector<Variant<Real>> variants{*scalar};
    variants.insert(variants.end(), packs.of, packs.of + packs.count);
    return variants;
}
template std::vector<Variant<float>> variants_of(std::string_view, Mode, std::int64_t);
template std::vector<Variant<double>> variants_of(std::string_view, Mode, std::int64_t);

}  // namespace mandelmarch::openmp
