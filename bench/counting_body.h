// SPDX-License-Identifier: Apache-2.0
// The pack that counts, over the text in one precision. Included in a namespace of its own; no guard.

// Runs `work` and adds what it cost to a stage.
template <class Body>
auto counted(Operations& to, Body body)
{
    const Operations before = operations();
    const auto result = body();
    to = to + (operations() - before);
    return result;
}

inline void count_pack(const void* data, std::span<const PixelPlace> pixels, PackCount& to)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    const auto stage = [&](Stage which) -> Operations& { return to.stages[static_cast<std::size_t>(which)]; };
    constexpr std::size_t most = 64;
    Ray rays[most];
    const std::size_t lanes = pixels.size() < most ? pixels.size() : most;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        rays[lane] = counted(stage(Stage::begin),
                             [&] { return begin(scene, real(scalar(pixels[lane].i)), real(scalar(pixels[lane].j))); });
    }
    // Step by step, as a pack does: it goes on while any lane does, and an estimate takes as long as its slowest lane.
    for (bool going = true; going;) {
        going = false;
        std::uint64_t slowest = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!marching(scene, rays[lane])) continue;
            going = true;
            const int before = rays[lane].iterations;
            rays[lane] = counted(stage(Stage::march), [&] { return march(scene, rays[lane], 1); });
            const auto done = static_cast<std::uint64_t>(rays[lane].iterations - before);
            slowest = done > slowest ? done : slowest;
            to.steps += 1;
            to.iterations += done;
        }
        if (going) to.step_slots += lanes;
        to.iteration_slots += lanes * slowest;
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        Hit hit = stopped(scene, rays[lane]);
        if (scene.canonical != 0) hit = counted(stage(Stage::refine), [&] { return refine(scene, hit); });
        Operations of_normal;
        if (is_hit(hit)) {
            ++to.hits;
            const real t = landing(scene, hit);
            const real back = (scene.canonical != 0 ? t : hit.t) * scene.tolerance;
            const vec3 p = along(along(wide(scene.eye), hit.direction, t), hit.direction, -back);
            counted(of_normal, [&] { return normal_at(scene, p, true); });
        }
        Operations of_shade;
        const Pixel pixel = counted(of_shade, [&] { return shade(scene, hit); });
        stage(Stage::normal) = stage(Stage::normal) + of_normal;
        stage(Stage::shade) = stage(Stage::shade) + (of_shade - of_normal);
        to.work.steps += static_cast<std::uint64_t>(pixel.steps);
        to.work.estimates += static_cast<std::uint64_t>(pixel.estimates);
        to.work.iterations += static_cast<std::uint64_t>(pixel.iterations);
    }
}
