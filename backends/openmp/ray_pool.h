// SPDX-License-Identifier: Apache-2.0
// A pool of rays, as a structure of arrays. Plain data, shared by code of several pack widths.
#pragma once

#include <cstdint>
#include <type_traits>

namespace mandelmarch::openmp {

constexpr int pool_rays = 4096;  // large enough for few gaps in packs, small enough for a core's cache
constexpr int block_side = 8;    // pixels; side of a subtile, whose rays begin together
constexpr int most_lanes = 64;   // per pack

template <class Real>
struct RayPool {
    using Whole = std::conditional_t<std::is_same_v<Real, float>, std::int32_t, std::int64_t>;

    static constexpr int reals = 11;
    static constexpr int wholes = 4;
    static constexpr int room = pool_rays + 2 * most_lanes;
    Real real_fields[reals][room];
    Whole whole_fields[wholes][room];
    int size;
};

}  // namespace mandelmarch::openmp
