// SPDX-License-Identifier: Apache-2.0
// The expected picture: the one with which tests and benchmarks compare a scene's picture.
#pragma once

#include <string>

#include "core/render/registry.h"

namespace mandelmarch {

// The backend and the options that render an expected picture.
struct ExpectedBy {
    const Backend* backend;
    RendererOptions options;
    std::string name;  // for messages
};

// Returns what renders the expected picture of a scene. Throws Unavailable if the registry has no such backend.
//   - In exact mode, it is the scalar kernel on the host (--simd-width 1), in the same precision.
//   - In fast mode, it is the reference in double. If the reference would take minutes (more than a million pixels) or
//     does not support the scene, it is the scalar kernel in double without cones and neighbours, so that each ray
//     begins by itself, and errors of both are found.
ExpectedBy expected_by(const Registry& registry, const Scene& scene, Precision precision, Mode mode);

}  // namespace mandelmarch
