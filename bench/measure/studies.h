// SPDX-License-Identifier: Apache-2.0
// The studies of bench as data. To add a sweep, add an entry in studies.cpp.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/result/result.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

// A configuration to measure, with the scene and options to render it.
struct Case {
    Row row;
    Scene scene;
    RendererOptions options;
    const Backend* backend = nullptr;  // nullptr if the backend has no device
};

// A point on an axis: its value, which becomes a part of row names, and the change that it makes to a configuration.
struct Point {
    std::string value;
    std::function<void(Case&)> set;
};

// One thing that a study varies. Each point adds NAME=VALUE to the sweep value of a row, unless VALUE is empty.
struct Axis {
    std::string_view name;
    std::function<std::vector<Point>(const Case& so_far)> points;  // `so_far`: as the axes before this one have set it
};

// Returns true if sweeps measure the backend. They leave out the reference, which would take minutes.
inline bool is_swept(const BackendInfo& info) { return info.role != Role::reference; }
inline bool any_case(const Case&) { return true; }

struct Study {
    std::string_view name, about;
    std::vector<Axis> axes = {};  // axes of this study only; cases.cpp adds the axes that all studies have
    // Returns true if the study measures this backend, for example because it has the option that varies.
    bool (*measures)(const BackendInfo&) = is_swept;
    bool (*keeps)(const Case&) = any_case;    // returns false for a configuration that the study leaves out
    std::vector<Mode> modes = {Mode::exact};  // if --mode is not given
    int width = 540, height = 540;            // pixels, if --size is not given
    bool baselines = false;                   // always includes the reference and the scalar kernel on the host
    bool counts = true, peaks = true;         // whether the study counts operations, and whether it measures peaks
    int most_rounds = 40;
    double row_budget = 8;  // seconds of timed pictures per configuration
};

const std::vector<Study>& studies();

// Returns the study with this name. Throws InputError, which lists the known names, if there is none.
const Study& study_named(std::string_view name);

}  // namespace mandelmarch::bench
