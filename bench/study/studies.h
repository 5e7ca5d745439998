// SPDX-License-Identifier: Apache-2.0
// The studies of bench as data: what each varies, and what it measures. A new sweep is one entry in studies.cpp.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/result/result.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {

// A sweep value, and the setting that it changes.
struct Point {
    std::string value;
    std::function<void(Setting&)> set;
};

// Sweeps leave out the reference, which would take minutes.
inline bool is_swept(const BackendInfo& info) { return info.role != Role::reference; }

struct Study {
    std::string_view name, about;
    std::string_view axis = {};  // what varies: a row's sweep value is AXIS=VALUE; empty if nothing varies
    std::function<std::vector<Point>(const Fractal&)> points = {};
    // Returns true if the study measures this backend, for example because it has the option that varies.
    bool (*measures)(const BackendInfo&) = is_swept;
    std::vector<Mode> modes = {Mode::exact};  // without --mode
    int width = 540, height = 540;            // pixels, without --size
};

const std::vector<Study>& studies();

// Returns the study with this name. Throws InputError, which lists the known names, if there is none.
const Study& study_named(std::string_view name);

}  // namespace mandelmarch::bench
