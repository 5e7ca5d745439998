// SPDX-License-Identifier: Apache-2.0
// Traces a ray with the functions of the text before it, in the order of its draw(). Included in the text's namespace;
// no guard.

inline std::array<double, 3> three(const vec3& v) { return {v.x, v.y, v.z}; }

// What the step from `before` to `after` decided.
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
        trace.marching.push_back({before.t, here.distance, tolerance(scene, ray), decision(scene, before, ray), ray.t});
    }
    return ray;
}

inline Ray traced_refine(const Scene& scene, Ray ray, Trace& trace)
{
    ray = refine_begin(scene, ray);
    if (ray.end == no_root()) return ray;
    trace.refined = Refined::close;
    for (int i = 0; refining(scene, ray); ++i) {
        if (i == 100) {  // refine()'s most
            trace.refined = Refined::out_of_roots;
            break;
        }
        ray = aimed(ray, true);
        if (ray.end == no_root()) {
            trace.refined = Refined::no_number;
            break;
        }
        const Estimate here = probe(scene, ray, true);
        ray = narrowed(scene, ray, here, true);
        trace.refining.push_back({ray.t, here.distance, scene.tolerance * ray.t,
                                  ray.end == tried_below() ? Decision::root_below : Decision::root_above, ray.t});
    }
    return ray;
}

// The normal that shade() takes, one tolerance before the hit.
inline std::array<double, 3> traced_normal(const Scene& scene, const Ray& ray)
{
    const real t = landing(scene, ray);
    const real back = scene.canonical != 0 ? scene.tolerance * t : tolerance(scene, ray);
    const vec3 p = along(point_at(scene, ray, t), ray.direction, -back);
    return three(facing(scene, ray.direction, normal_at(scene, p, true).direction, t));
}

inline void trace_ray(const Scene& scene, Trace& trace)
{
    Ray ray = begin(scene, static_cast<real>(trace.x), static_cast<real>(trace.y));
    trace.stride = scene.stride;
    trace.relaxation = scene.relaxation;
    trace.direction = three(ray.direction);
    trace.begin = ray.t;
    trace.end = ray.end;
    ray = traced_march(scene, ray, trace);
    if (scene.canonical != 0) ray = traced_refine(scene, ray, trace);
    trace.hit = has_hit(scene, ray);
    if (trace.hit) trace.normal = traced_normal(scene, ray);

    const Pixel pixel = shade(scene, ray);
    const real reals[] = {pixel.colour.x, pixel.colour.y, pixel.colour.z, pixel.depth};
    const int wholes[] = {pixel.steps, pixel.estimates, pixel.iterations};
    Image image(1, 1, Image::Layers::all);
    image.store(planes_of(reals, wholes, 1, 1), 0, 0, 1, 1);
    trace.pixel = image.values().front();
    std::copy_n(image.bytes().begin(), trace.bytes.size(), trace.bytes.begin());
    trace.estimates = pixel.estimates;
}
