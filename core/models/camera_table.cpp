// SPDX-License-Identifier: Apache-2.0
#include "core/models/camera_table.h"

#include <cmath>
#include <cstring>

namespace mandelmarch::job {
namespace {

namespace f64 {
#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/scene.h"
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "core/kernel/camera.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
}  // namespace f64
namespace f32 {
#define MM_REAL float
#define MM_REAL_IS_FLOAT 1
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/scene.h"
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "core/kernel/camera.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
}  // namespace f32

// Appends the complex numbers of(0) to of(count - 1): first all real parts, then all imaginary parts.
template <class Real, class Of>
void put(std::vector<Real>& table, int count, Of of)
{
    const std::size_t first = table.size();
    table.resize(first + 2 * static_cast<std::size_t>(count));
    for (int at = 0; at < count; ++at) {
        const auto found = of(static_cast<Real>(at));
        table[first + static_cast<std::size_t>(at)] = found.re;
        table[first + static_cast<std::size_t>(count + at)] = found.im;
    }
}

}  // namespace

#define MM_TABLE(text, real)                                                       \
    std::vector<real> camera_table(const layout_##text::Scene& scene)              \
    {                                                                              \
        text::Scene same;                                                          \
        static_assert(sizeof same == sizeof scene);                                \
        std::memcpy(&same, &scene, sizeof same);                                   \
        const bool flat = !(same.longitudes > 0);                                  \
        std::vector<real> table;                                                   \
        put(table, same.width, [&](real i) {                                       \
            const real u = text::picture_place(i, static_cast<real>(same.width));  \
            return flat ? text::complex_number(1, u) : text::column_of(same, u);   \
        });                                                                        \
        put(table, same.height, [&](real j) {                                      \
            const real v = text::picture_place(j, static_cast<real>(same.height)); \
            return flat ? text::complex_number(1, v) : text::row_of(same, v);      \
        });                                                                        \
        return table;                                                              \
    }
MM_TABLE(f64, double)
MM_TABLE(f32, float)
#undef MM_TABLE

}  // namespace mandelmarch::job
