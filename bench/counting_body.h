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
        Pixel pixel = counted(stage(Stage::shade), [&] { return missed(scene, hit); });
        if (is_hit(hit)) {
            ++to.hits;
            const ShadingPoint at = counted(stage(Stage::shade), [&] { return shading_point(scene, hit); });
            const Normal normal = counted(stage(Stage::normal), [&] { return normal_at(scene, at.p, at.t, true); });
            pixel = counted(stage(Stage::shade), [&] { return shade_with(scene, hit, pixel, at, normal); });
        }
        to.work.steps += static_cast<std::uint64_t>(pixel.steps);
        to.work.estimates += static_cast<std::uint64_t>(pixel.estimates);
        to.work.iterations += static_cast<std::uint64_t>(pixel.iterations);
    }
}
