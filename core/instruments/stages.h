// SPDX-License-Identifier: Apache-2.0
// Renders a pixel as draw() does (core/kernel/shade.h), with an observer of its stages. This file is included after the
// kernel source in the same namespace, once per variant of the kernel; it must not have an include guard.
//
// The observer's functions:
// - stage(which, body) returns body(), whose operations belong to the stage;
// - marched(scene, ray) marches the ray until it stops;
// - refined(scene, hit) refines the hit completely;
// - hits(scene, hit, at, normal) is called before a hit is shaded, with its shading point and the normal there.

template <class Observer>
Pixel observed_pixel(const Scene& scene, int column, int row, Observer& observer)
{
    const Ray ray = observer.stage(Stage::begin, [&] { return begin(scene, real(scalar(column)), real(scalar(row))); });
    Hit hit = stopped(scene, observer.marched(scene, ray));
    if (scene.canonical != 0) hit = observer.refined(scene, hit);
    const Pixel pixel = observer.stage(Stage::shade, [&] { return missed(scene, hit); });
    if (!is_hit(hit)) return pixel;
    const ShadingPoint at = observer.stage(Stage::shade, [&] { return shading_point(scene, hit); });
    const Normal normal = observer.stage(Stage::normal, [&] { return normal_at(scene, at.p, at.t, true); });
    observer.hits(scene, hit, at, normal);
    return observer.stage(Stage::shade, [&] { return shade_with(scene, hit, pixel, at, normal); });
}
