// SPDX-License-Identifier: Apache-2.0
// Code divergence: how much of what a backend needs is its own (Harrell and Kitson, "Effective Performance
// Portability", P3HPC 2018), and code convergence, which is 1 less that (Pennycook, Sewall and others, "Navigating
// Performance, Portability and Productivity", Computing in Science & Engineering 23, 2021).
//
// An application is this program, a platform one of its backends, and what a platform needs are the lines of its
// folder, of core/kernel and of core/job, as far as its sources name them. A line is one with more than blanks and
// comments. Of two backends with the sets of lines a and b the distance is 1 - |a n b| / |a u b|; the divergence is the
// mean over all pairs.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch::bench {

// The numbers, from 1, of the lines of a C or C++ source that are more than blanks and comments.
std::vector<int> lines_of_code(std::string_view text);

// By file, from the source tree's folder.
using Coverage = std::map<std::string, std::vector<int>>;

// The share of the lines of both that one of them is without; 0 where there are none.
double distance(const Coverage& one, const Coverage& other);

// The mean of the distances of all pairs; 0 where there are fewer than two.
double mean_distance(const std::vector<Coverage>& all);

struct ModelLines {
    std::string backend;
    Coverage coverage;
    int own = 0, job = 0, kernel = 0;  // lines of its folder, of core/job, of core/kernel
};

struct Divergence {
    std::vector<ModelLines> models;  // in the order of backends/CMakeLists.txt
    double divergence = 0;
    double without_one_text = 0;  // what it were if each backend had a core/kernel of its own
};

// Of a source tree. Backends that do not compile core/kernel are no platforms of it: the reference. Throws InputError
// where the folder holds no such tree.
Divergence divergence_of(const std::string& folder);

nlohmann::ordered_json json_of(const Divergence& divergence);

// The columns problem, application, platform and coverage, as p3-analysis-library's divergence() reads them.
std::string to_csv(const Divergence& divergence);

// The table of `bench divergence`.
std::string to_console(const Divergence& divergence);

}  // namespace mandelmarch::bench
