// SPDX-License-Identifier: Apache-2.0
// The output folder of demo: pictures as PNG files, and the table as demo.json. The report's page is made from them.
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
    int simd_width = 0;  // RendererOptions::simd_width
    Precision precision = Precision::f64;
    Mode mode = Mode::exact;
    bool drawn = false;   // false: the backend is unavailable, or the device failed
    bool ok = true;       // false: the picture differs too much, or the device failed
    std::string said;     // the result of the comparison, or the reason why no picture was rendered
    std::string device;   // name of the device used
    double seconds = 0;   // wall time of the row's fastest picture
    double speed_up = 0;  // wall time of the reference in exact mode divided by `seconds`
    std::string picture;  // name of the picture's file in the folder; empty: none
};

class DemoFolder {
public:
    // Creates the folder if it does not exist. If `path` is empty, nothing is written. Throws Error if the folder
    // cannot be created.
    explicit DemoFolder(std::string path);

    // Writes the row's picture and sets row.picture.
    void picture(DemoRow& row, const Image& image) const;
    // Writes demo.json. `side`: width and height of the pictures in pixels; `repetitions`: the largest number of
    // pictures rendered per row.
    void table(const std::vector<DemoRow>& rows, int side, int repetitions) const;

private:
    std::string path_;
};

}  // namespace mandelmarch
