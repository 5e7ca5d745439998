// SPDX-License-Identifier: Apache-2.0
// Renders one pixel and counts its operations. Included inside a namespace, once for each precision, so it has no
// include guard.

// Calls `body`, adds the operations of the call to `to`, and returns the result of the call.
template <class Body>
auto counted(Operations& to, Body body)
{
    const Operations before = operations();
    const auto result = body();
    to = to + (operations() - before);
    return result;
}

inline void count_pixel(const void* data, int i, int j, PixelCount& to, RaySteps& steps)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    const auto stage = [&](Stage which) -> Operations& { return to.stages[static_cast<std::size_t>(which)]; };
    Ray ray = counted(stage(Stage::begin), [&] { return begin(scene, real(scalar(i)), real(scalar(j))); });
    while (marching(scene, ray)) {
        const int before = ray.iterations;
        ray = counted(stage(Stage::march), [&] { return march(scene, ray, 1); });
        steps.push_back(ray.iterations - before);
    }
    Hit hit = stopped(scene, ray);
    if (scene.canonical != 0) hit = counted(stage(Stage::refine), [&] { return refine(scene, hit); });
    Pixel pixel = counted(stage(Stage::shade), [&] { return missed(scene, hit); });
    if (is_hit(hit)) {
        ++to.hits;
        const ShadingPoint at = counted(stage(Stage::shade), [&] { return shading_point(scene, hit); });
        const Normal normal = counted(stage(Stage::normal), [&] { return normal_at(scene, at.p, at.t, true); });
        pixel = counted(stage(Stage::shade), [&] { return shade_with(scene, hit, pixel, at, normal); });
    }
    to.work.steps += static_cast<std::uint64_t>(pixel.steps);
    to.work.de_calls += static_cast<std::uint64_t>(pixel.de_calls);
    to.work.iterations += static_cast<std::uint64_t>(pixel.iterations);
}
