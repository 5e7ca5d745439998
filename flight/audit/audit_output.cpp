// SPDX-License-Identifier: Apache-2.0
// The output of an audit as a table and as JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/scene/fractal.h"
#include "flight/audit/audit.h"

namespace mandelmarch {

std::string table_of(const Path& path, const Audit& audit)
{
    std::string text = fmt::format("{}, seed {}, {} frames ({:.1f} s); ! is a promise, the others are quality\n",
                                   path.scene.fractal->name, path.seed, path.frames.size(),
                                   static_cast<double>(path.frames.size()) / path.frames_per_second);
    for (const Row& row : audit.rows) {
        const auto value = [&](double v) {
            return fmt::format("{:.4g}{}{}", v, row.unit.empty() ? "" : " ", row.unit);
        };
        text += fmt::format("{} {:<54} {:>10}  {} {:<8} {}{}{}\n", row.promise ? '!' : ' ', row.name, value(row.value),
                            row.at_most ? "<=" : ">=", value(row.bar),
                            row.kept()    ? "kept"
                            : row.promise ? "BROKEN"
                                          : "missed",
                            row.worst.empty() ? "" : "  ", row.worst);
    }
    return text;
}

std::string json_of(const Path& path, const Audit& audit)
{
    nlohmann::ordered_json json{{"schema", 1},
                                {"program", version_line("flythrough")},
                                {"fractal", path.scene.fractal->name},
                                {"seed", path.seed},
                                {"frames", path.frames.size()},
                                {"promises_kept", audit.promises_kept()},
                                {"bars_missed", audit.bars_missed()},
                                {"rows", nlohmann::ordered_json::array()}};
    for (const Row& row : audit.rows) {
        json["rows"].push_back({{"name", row.name},
                                {"value", row.value},
                                {"bar", row.bar},
                                {"at_most", row.at_most},
                                {"promise", row.promise},
                                {"unit", row.unit},
                                {"kept", row.kept()},
                                {"worst", row.worst}});
    }
    return json.dump(2) + "\n";
}

}  // namespace mandelmarch
