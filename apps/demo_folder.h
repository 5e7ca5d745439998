// SPDX-License-Identifier: Apache-2.0
// What demo leaves in a folder: its pictures as PNG, and its table as demo.json, from which its page is made.
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
    bool fine = true;     // false: the picture, or the device, failed
    std::string said;     // the proof, or why nothing was drawn
    std::string device;   // that drew it
    double seconds = 0;   // wall time of the fastest picture
    double speed_up = 0;  // over the reference, exact
    std::string picture;  // file in the folder, empty without one
};

class DemoFolder {
public:
    // Makes the folder where it is missing. An empty path: nothing is ever written. Throws Error.
    explicit DemoFolder(std::string path);

    // Writes the row's picture and names it there.
    void picture(DemoRow& row, const Image& image) const;
    // Writes demo.json. side: pixels of a picture's side; repetitions: pictures at most of which a row shows the
    // fastest.
    void table(const std::vector<DemoRow>& rows, int side, int repetitions) const;

private:
    std::string path_;
};

}  // namespace mandelmarch
