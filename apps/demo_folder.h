// SPDX-License-Identifier: Apache-2.0
// The output folder of demo: pictures as PNG, and the table as demo.json, from which the report's page is made.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"
#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// One line of demo's table.
struct DemoRow {
    std::string fractal, backend;
    int pack = 0;  // RendererOptions::pack
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    bool drawn = false;   // false: unavailable, or the device failed
    bool ok = true;       // false: the picture is wrong, or the device failed
    std::string said;     // the result of the comparison, or the reason why there is no picture
    std::string device;   // name of the device used
    double seconds = 0;   // wall time of the fastest picture
    double speed_up = 0;  // relative to the reference in exact mode
    std::string picture;  // file name in the folder; empty: none
};

class DemoFolder {
public:
    // Creates the folder if it is missing. With an empty path, nothing is written. Throws Error.
    explicit DemoFolder(std::string path);

    // Writes the row's picture and sets row.picture.
    void picture(DemoRow& row, const Image& image) const;
    // Writes demo.json. `side`: of a picture, pixels; `repetitions`: the largest number of pictures per row.
    void table(const std::vector<DemoRow>& rows, int side, int repetitions) const;

private:
    std::string path_;
};

}  // namespace mandelmarch
