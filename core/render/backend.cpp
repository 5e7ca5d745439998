// SPDX-License-Identifier: Apache-2.0
#include "core/render/backend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

struct NamedTechnique {
    std::string_view name;
    bool Techniques::*member;
};

constexpr std::array names_of_techniques{NamedTechnique{"hull", &Techniques::hull},
                                         NamedTechnique{"relaxation", &Techniques::relaxation},
                                         NamedTechnique{"cones", &Techniques::cones},
                                         NamedTechnique{"neighbours", &Techniques::neighbours},
                                         NamedTechnique{"trial", &Techniques::trial},
                                         NamedTechnique{"refinement", &Techniques::refinement},
                                         NamedTechnique{"tail", &Techniques::tail},
                                         NamedTechnique{"gradient", &Techniques::gradient},
                                         NamedTechnique{"shared-occlusion", &Techniques::shared_occlusion}};

}  // namespace

void Progress::operator()(double share) const
{
    if (cancelled()) throw Cancelled();
    if (told_) told_(share);
}

std::string_view name_of(Precision precision) { return precision == Precision::f64 ? "double" : "float"; }

std::string_view name_of(Mode mode) { return mode == Mode::exact ? "exact" : "fast"; }

std::string variant_name(std::string_view fractal, Precision precision, Mode mode)
{
    return fmt::format("{}_{}_{}", fractal, name_of(precision), name_of(mode));
}

std::string_view name_of(Role role)
{
    constexpr std::array<std::string_view, 4> names{"", "reference", "host", "accelerator"};
    return names.at(static_cast<std::size_t>(role));
}

Techniques techniques_without(std::string_view names)
{
    Techniques techniques;
    if (names.empty()) return techniques;
    for (const std::string_view name : split(names, ',')) {
        const auto found = std::ranges::find(names_of_techniques, name, &NamedTechnique::name);
        if (found == names_of_techniques.end()) {
            const auto known = mapped(names_of_techniques, &NamedTechnique::name);
            throw InputError(
                fmt::format("no technique is called '{}', expected some of {}", name, fmt::join(known, ", ")));
        }
        techniques.*found->member = false;
    }
    return techniques;
}

std::string disabled(const Techniques& techniques)
{
    std::vector<std::string_view> names;
    for (const NamedTechnique& one : names_of_techniques) {
        if (!(techniques.*one.member)) names.push_back(one.name);
    }
    return fmt::format("{}", fmt::join(names, ","));
}

Timings& operator+=(Timings& to, const Timings& from)
{
    to.build += from.build;
    to.upload += from.upload;
    to.kernel += from.kernel;
    to.trial += from.trial;
    to.host += from.host;
    to.readback += from.readback;
    to.wall += from.wall;
    return to;
}

Work& operator+=(Work& to, const Work& from)
{
    to.steps += from.steps;
    to.de_calls += from.de_calls;
    to.iterations += from.iterations;
    return to;
}

template <class Real>
void add_work(Work& work, const Planes<Real>& planes, int width, int height)
{
    for (int y = 0; y < height; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * planes.stride;
        for (std::size_t at = row; at < row + static_cast<std::size_t>(width); ++at) {
            work.steps += static_cast<std::uint64_t>(planes.steps[at]);
            work.de_calls += static_cast<std::uint64_t>(planes.de_calls[at]);
            work.iterations += static_cast<std::uint64_t>(planes.iterations[at]);
        }
    }
}

void add_cone_work(Work& work, std::span<const int> cones)
{
    for (std::size_t at = 0; at + 1 < cones.size(); at += 2) {
        work.de_calls += static_cast<std::uint64_t>(cones[at]);
        work.iterations += static_cast<std::uint64_t>(cones[at + 1]);
    }
}

template void add_work(Work&, const Planes<float>&, int, int);
template void add_work(Work&, const Planes<double>&, int, int);

}  // namespace mandelmarch
