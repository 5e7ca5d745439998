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
#include "core/scene/scene.h"

namespace mandelmarch::bench {

// A configuration to measure, with the scene and options to render it.
struct Case {
    Row row;
    Scene scene;
    RendererOptions options;
    const Backend* backend = nullptr;  // nullptr if the backend has no device
};

// A point on an axis: its value, as in a row's name, and the change that it makes to a configuration.
struct Point {
    std::string value;
    std::function<void(Case&)> set;
};

// One thing that varies. A row's sweep value is NAME=VALUE; a point with an empty value leaves it out.
struct Axis {
    std::string_view name;
    std::function<std::vector<Point>(const Case& so_far)> points;  // `so_far`: set by the axes before this one
};

// Sweeps leave out the reference, which would take minutes.
inline bool is_swept(const BackendInfo& info) { return info.role != Role::reference; }
inline bool any_case(const Case&) { return true; }

struct Study {
    std::string_view name, about;
    std::vector<Axis> axes = {};  // axes of this study alone; cases.cpp adds those of all studies
    // Returns true if the study measures this backend, for example because it has the option that varies.
    bool (*measures)(const BackendInfo&) = is_swept;
    bool (*keeps)(const Case&) = any_case;    // returns false for a configuration that the study leaves out
    std::vector<Mode> modes = {Mode::exact};  // without --mode
    int width = 540, height = 540;            // pixels, without --size
    bool baselines = false;                   // always includes the reference and the scalar kernel on the host
    bool counts = true, peaks = true;         // counts operations; measures peaks
    bool stages = false;                      // measures the time of each stage
    int most_rounds = 40;
    double row_budget = 8;  // seconds of timed pictures per configuration
};

const std::vector<Study>& studies();

// Returns the study with this name. Throws InputError, which lists the known names, if there is none.
const Study& study_named(std::string_view name);

}  // namespace mandelmarch::bench
