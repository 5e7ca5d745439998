// SPDX-License-Identifier: Apache-2.0
// The fields of the files that `bench random --json` and `bench equivalence --json` write.
#pragma once

#include <string>

#include "bench/scenes/equivalence.h"
#include "bench/files/fields.h"
#include "bench/scenes/random_scenes.h"
#include "bench/files/result_fields.h"
#include "core/scene/fractal.h"

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
inline constexpr auto fields_of<RandomRow> = Description{
    "scene",
    derived_field("fractal", [](const RandomRow& row) { return std::string(row.scene.fractal->short_name); }),
    field("precision", &RandomRow::precision),
    field("set", &RandomRow::set),
    field("number", &RandomRow::number),
    derived_field("off", [](const RandomRow& row) { return std::uint64_t{row.off.visibly_differing}; }, "",
                  {.about = "Pixels."}),
    derived_field("hit_or_miss", [](const RandomRow& row) { return std::uint64_t{row.off.hit_or_miss}; }, "",
                  {.about = "Pixels that hit instead of miss, or miss instead of hit."}),
    derived_field("exact_off_percent", [](const RandomRow& row) { return 100 * row.exact_off; })};

template <>
inline constexpr auto fields_of<RandomResult> =
    Description{"random",
                derived_field("backend", [](const RandomResult& result) { return result.options.backend; }),
                derived_field("without", [](const RandomResult& result) { return result.options.without; }, "",
                              {.about = "Disabled optimisations, separated by commas."}),
                field("width", &RandomResult::width),
                field("height", &RandomResult::height),
                field("environment", &RandomResult::environment),
                field("sums", &RandomResult::sums),
                field("scenes", &RandomResult::rows)};

template <>
inline constexpr auto fields_of<Tested> =
    Description{"subject",
                field("backend", &Tested::backend),
                field("device", &Tested::device),
                derived_field("simd_width", [](const Tested& tested) { return tested.options.simd_width; }, "",
                              {.about = "0: chosen by the backend."}),
                derived_field("precision", [](const Tested& tested) { return tested.options.precision; }),
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
                derived_field("scenes", [](const EquivalenceResult& result) { return result.options.scenes; }),
                derived_field("seed", [](const EquivalenceResult& result) { return result.options.seed; }),
                derived_field("fractal",
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

}  // namespace mandelmarch::bench
