// SPDX-License-Identifier: Apache-2.0
// Code divergence: the fraction of the code needed by a backend that other backends do not share (Harrell and Kitson,
// "Effective Performance Portability", P3HPC 2018), and code convergence, which is 1 - divergence (Pennycook, Sewall
// and others, "Navigating Performance, Portability and Productivity", Computing in Science & Engineering 23, 2021).
//
// The application is this program, and each backend is a platform. A platform needs the lines of the files in its
// backend's folder, and of those files in core/kernel and core/job that its sources name, directly or indirectly. Blank
// lines and comments do not count. If two backends need the sets of lines a and b, their distance is
// 1 - |a n b| / |a u b|. The divergence is the mean distance over all pairs of backends.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch::bench {

// Returns the line numbers, from 1, of the lines that contain code in a C or C++ source.
std::vector<int> lines_of_code(std::string_view text);

// Lines of code by file; paths are relative to the source tree.
using Coverage = std::map<std::string, std::vector<int>>;

// Returns the distance of two sets of lines: among the lines in either set, the fraction that is in only one of them; 0
// without lines.
double distance(const Coverage& one, const Coverage& other);

// Returns the mean distance over all pairs of sets; 0 for fewer than two sets.
double mean_distance(const std::vector<Coverage>& all);

struct ModelLines {
    std::string backend;
    Coverage coverage;
    int own = 0, job = 0, kernel = 0;  // numbers of lines in the backend's folder, in core/job and in core/kernel
};

struct Divergence {
    std::vector<ModelLines> models;  // in the order of backends/CMakeLists.txt
    double divergence = 0;
    double without_one_text = 0;  // what `divergence` would be if each backend had its own copy of core/kernel
};

// Measures the code divergence of a source tree. Backends that do not compile core/kernel (the reference) are left out.
// Throws InputError if the folder is not a source tree of this program.
Divergence divergence_of(const std::string& folder);

nlohmann::ordered_json json_of(const Divergence& divergence);

// Returns the columns problem, application, platform and coverage, as read by p3-analysis-library's divergence().
std::string to_csv(const Divergence& divergence);

// Returns the table of `bench divergence`.
std::string to_console(const Divergence& divergence);

}  // namespace mandelmarch::bench
