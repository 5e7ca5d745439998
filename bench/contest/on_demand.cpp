// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/on_demand.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/machine/environment.h"
#include "bench/contest/line_socket.h"
#include "bench/harness/verify.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

Json row_of(const Case& one, std::uint64_t fingerprint)
{
    const Row& row = one.row;
    return {{"name", row.name()},
            {"in_process", !one.backend->info().has_driver},
            {"fingerprint", fmt::format("{:016x}", fingerprint)},
            {"failure", row.failure.empty() ? Json() : Json(row.failure)}};
}

Json answer(std::vector<TimedCase>& rows, Image& image, const std::string& name)
{
    const auto found = std::ranges::find(rows, name, [](const TimedCase& live) { return live.one->row.name(); });
    if (found == rows.end()) return {{"failure", "no such row"}};
    const Scene& scene = found->one->scene;
    if (image.width() != scene.width || image.height() != scene.height) {
        image = Image(scene.width, scene.height, Image::Layers::bytes);
    }
    try {
        const Sample sample = draw_sample(*found, image);
        return {{"kernel", sample.kernel}, {"processor", sample.processor}};
    } catch (const std::exception& error) {
        return {{"failure", error.what()}};
    }
}

}  // namespace

void draw_on_demand(const Registry& registry, const Options& options, bool prove)
{
    std::vector<Case> cases = cases_of(registry, options);
    ExpectedPictures pictures(registry);
    std::vector<Case*> order = pictures.grouped(cases);
    std::vector<TimedCase> ready;
    Json rows = Json::array();
    for (Case* one : order) {
        auto live = prove ? verified_case(*one, pictures) : unverified_case(*one);
        if (!one->row.unavailable.empty()) continue;
        rows.push_back(row_of(*one, live ? live->fingerprint : 0));
        if (live) ready.push_back(std::move(*live));
    }
    LineSocket socket(Descriptor(dup(STDIN_FILENO)));
    socket.send(text_of_line({{"version", on_demand_version}, {"environment", environment(registry)}, {"rows", rows}}));
    Image image;
    for (std::string name; socket.receive(name);) socket.send(text_of_line(answer(ready, image, name)));
}

}  // namespace mandelmarch::bench
