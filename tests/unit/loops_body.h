// SPDX-License-Identifier: Apache-2.0
// The kernel with a counter of loop iterations, and a function that renders a picture with this kernel. There is no
// include guard, because the file is included for each fractal, in a namespace.

#define FN_CALLED inline
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/prelude/counted_loops.h"
#include "core/kernel/text.h"
#include "core/kernel/prelude/undefine.h"

// Renders the scene in exact mode (`plain_scene`) and in fast mode (`fast_scene`). Returns the largest loop counts of
// the rays.
inline Loops made_by(const void* plain_scene, const void* fast_scene)
{
    const Scene& plain = *static_cast<const Scene*>(plain_scene);
    const Scene& fast = *static_cast<const Scene*>(fast_scene);
    Loops most{};
    const auto take = [](std::int64_t& to, std::int64_t made) { to = std::max(to, made); };
    for (int j = 0; j < plain.height; ++j) {
        for (int i = 0; i < plain.width; ++i) {
            Ray ray = begin(plain, i, j);
            take(most.pass, counted([&] { march(plain, ray, 0); }));
            while (marching(plain, ray)) {
                take(most.step, counted([&] { ray = march(plain, ray, 1); }) - most.pass);
            }
            take(most.shade, counted([&] { shade(plain, stopped(plain, ray)); }));
            Hit hit = stopped(fast, march(fast, begin(fast, i, j), fast.max_steps));
            const std::int64_t none = counted([&] { refine_by(fast, hit, 0); });
            take(most.tried, counted([&] { refine_by(fast, hit, 1); }) - none);
            take(most.refine, counted([&] { hit = refine(fast, hit); }));
            take(most.shade, counted([&] { shade(fast, hit); }));
        }
    }
    return most;
}
