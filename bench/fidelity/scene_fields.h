// SPDX-License-Identifier: Apache-2.0
// The fields of the files that `bench random --json` and `bench equivalence --json` write.
#pragma once

#include <string>

#include "bench/fidelity/equivalence.h"
#include "bench/fidelity/random_scenes.h"
#include "bench/result/document.h"
#include "bench/result/result_fields.h"

namespace mandelmarch::bench {

template <>
inline constexpr auto fields_of<RandomSum> =
    Description{"sum",
                field("scenes", &RandomSum::scenes),
                field("pixels", &RandomSum::pixels),
                derived_field("off_percent", [](const RandomSum& sum) { return 100 * sum.off(); }),
                derived_field("hit_or_miss_percent", [](const RandomSum& sum) { return 100 * sum.wrong_hits(); }),
                field("scenes_far_off", &RandomSum::far_off),
                field("of_these_short_of_digits", &RandomSum::short_of_digits),
                derived_field("worst_off_percent", [](const RandomSum& sum) { return 100 * sum.worst; })};

template <>
inline constexpr auto fields_of<RandomSums> =
    Description{"sums", field("fractal", &RandomSums::fractal), field("precision", &RandomSums::precision),
                field("all", &RandomSums::all),
                field("sets", &RandomSums::sets, "", {.about = "Sums over each set, by the seed of the set."})};

template <>
inline constexpr auto fields_of<RandomRow> =
    Description{"scene",
                field("fractal", &RandomRow::fractal, "", rules::required),
                field("precision", &RandomRow::precision, "", rules::required),
                field("set", &RandomRow::set, "", rules::required),
                field("number", &RandomRow::number, "", rules::required),
                field("off", &RandomRow::off, "", {.required = true, .about = "Pixels."}),
                field("hit_or_miss", &RandomRow::hit_or_miss, "",
                      {.required = true, .about = "Pixels that hit instead of miss, or miss instead of hit."}),
                field("exact_off_percent", &RandomRow::exact_off_percent, "", {.max = 100})};

template <>
inline constexpr auto fields_of<RandomResult> =
    Description{"random",
                field("backend", &RandomResult::backend),
                field("without", &RandomResult::without, "", {.about = "Disabled optimisations, separated by commas."}),
                field("width", &RandomResult::width, "", rules::required),
                field("height", &RandomResult::height, "", rules::required),
                field("environment", &RandomResult::environment),
                derived_field("sums", &RandomResult::sums),
                field("scenes", &RandomResult::rows, "", rules::required)};

template <>
inline constexpr Format format_of<RandomResult>{"mandelmarch-bench-random", 1};

template <>
inline constexpr auto fields_of<Tested> =
    Description{"subject",
                field("backend", &Tested::backend),
                field("device", &Tested::device),
                field("simd_width", [](const Tested& tested) { return tested.options.simd_width; }, "",
                      {.about = "0: chosen by the backend."}),
                field("precision", [](const Tested& tested) { return tested.options.precision; }),
                field("pictures", &Tested::pictures),
                field("unavailable", &Tested::unavailable, "",
                      {.about = "Number of scenes that the configuration does not support."}),
                field("refusal", &Tested::refusal, "", {.about = "Why the first of these scenes is not supported."}),
                field("wrong", &Tested::wrong)};

template <>
inline constexpr auto fields_of<Discrepancy> = Description{
    "discrepancy", field("scene", &Discrepancy::scene), field("subject", &Discrepancy::subject),
    field("what", &Discrepancy::what),
    field("parameters", &Discrepancy::parameters, "", {.about = "Contents of the scene's parameter file."})};

template <>
inline constexpr auto fields_of<EquivalenceResult> =
    Description{"equivalence",
                field("scenes", [](const EquivalenceResult& result) { return result.options.scenes; }),
                field("seed", [](const EquivalenceResult& result) { return result.options.seed; }),
                field("fractal",
                      [](const EquivalenceResult& result) {
                          const auto& one = result.options.fractals;
                          return std::string(one.empty() ? "all" : one.front()->short_name);
                      }),
                field("environment", &EquivalenceResult::environment),
                field("missing", &EquivalenceResult::missing, "",
                      {.about = "A line for each backend without a device, with the reason."}),
                field("failures", &EquivalenceResult::failures),
                field("subjects", &EquivalenceResult::subjects),
                field("discrepancies", &EquivalenceResult::discrepancies)};

template <>
inline constexpr Format format_of<EquivalenceResult>{"mandelmarch-bench-equivalence", 2};

}  // namespace mandelmarch::bench
