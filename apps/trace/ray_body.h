// SPDX-License-Identifier: Apache-2.0
// Traces a ray by calling the kernel's functions in the same order as its draw(). This file is included after the
// kernel source in the same namespace, once per variant of the kernel; it must not have an include guard.

inline std::array<double, 3> three(const vec3& v) { return {v.x, v.y, v.z}; }

// Returns the decision made at the sample of `before`; `after` is the ray after that sample.
inline Decision decision(const Scene& scene, const Ray& before, const Ray& after)
{
    if (marching(scene, after)) return after.last_t == before.t ? Decision::step : Decision::taken_back;
    if (has_hit(scene, after)) return Decision::hit;
    if (!(after.last_distance > tolerance(scene, after))) return Decision::undecided;
    if (after.t > after.end) return Decision::left;
    return after.steps >= scene.max_steps ? Decision::out_of_steps : Decision::undecided;
}

inline Ray traced_march(const Scene& scene, Ray ray, Trace& trace)
{
    while (marching(scene, ray)) {
        const Ray before = ray;
        const Estimate here = probe(scene, before, true);
        ray = advanced(scene, before, here, true);
        trace.marching.push_back({before.t, here.distance, tolerance(scene, ray), decision(scene, before, ray), ray.t,
                                  static_cast<int>(here.iterations)});
    }
    return ray;
}

inline Hit traced_refine(const Scene& scene, Hit hit, Trace& trace)
{
    if (!(hit.state > settled())) return hit;
    trace.refined = Refined::close;
    for (int i = 0; refining(scene, hit); ++i) {
        if (i == most_tries()) {
            trace.refined = Refined::out_of_roots;
            break;
        }
        hit = aimed(hit, true);
        if (hit.state == settled()) {
            trace.refined = Refined::no_number;
            break;
        }
        const Estimate here = probe_root(scene, hit, true);
        hit = narrowed(scene, hit, here, true);
        trace.refining.push_back({hit.t, here.distance, scene.tolerance * hit.t,
                                  hit.state == tried_below() ? Decision::root_below : Decision::root_above, hit.t});
    }
    return hit;
}

// Returns the normal that shade() uses. It is computed one tolerance before the hit.
inline std::array<double, 3> traced_normal(const Scene& scene, const Hit& hit)
{
    const ShadingPoint at = shading_point(scene, hit);
    return three(facing(scene, hit.direction, normal_at(scene, at.p, at.t, true).direction, at.t));
}

inline void trace_ray(const Scene& scene, Trace& trace)
{
    Ray ray = begin(scene, static_cast<real>(trace.x), static_cast<real>(trace.y));
    trace.step_factor = scene.step_factor;
    trace.relaxation = scene.relaxation;
    trace.direction = three(ray.direction);
    trace.begin = ray.t;
    trace.end = ray.end;
    ray = traced_march(scene, ray, trace);
    Hit hit = stopped(scene, ray);
    if (scene.canonical != 0) hit = traced_refine(scene, hit, trace);
    trace.hit = is_hit(hit);
    if (trace.hit) trace.normal = traced_normal(scene, hit);

    const Pixel pixel = shade(scene, hit);
    const real reals[] = {pixel.colour.x, pixel.colour.y, pixel.colour.z, pixel.depth};
    const int wholes[] = {pixel.steps, pixel.de_calls, pixel.iterations};
    Image image(1, 1, Image::Layers::all);
    image.store(planes_of(reals, wholes, 1, 1), 0, 0, 1, 1);
    trace.pixel = image.values().front();
    std::copy_n(image.bytes().begin(), trace.bytes.size(), trace.bytes.begin());
    trace.de_calls = pixel.de_calls;
}
