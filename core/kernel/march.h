// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 8: marches a ray from the camera until it hits the surface or leaves the scene. Call order:
// begin(); march() any number of times.

// Begins a ray from the camera. `direction` may have any length. Outside a hull of the size `hull_size`, the ray takes
// no samples; 0: the hull is unknown.
FN Ray begin_inside(Scene scene, scalar hull_size, vec3 direction)
{
    Ray ray;
    ray.direction = unit(direction);
    ray.end = scene.end;
    ray.t = 0;
    if (hull_size > 0) {
        Span span = MM_HULL_SPAN(hull_size, splat(scene.eye), ray.direction);
        // The margin exceeds the rounding error of the end of the span.
        ray.end = smaller(ray.end, span.last * R(1.0001));
        ray.end = pick(span.first <= span.last, larger(ray.end, -1), R(-1.0));
        // Rays of the original stepping begin at the eye.
        if (scene.canonical != 0) ray.t = larger(span.first * R(0.9999), 0);
    }
    ray.last_t = 0;
    ray.last_distance = scene.end;  // exceeds the tolerance at any first sample, so that marching() is true
    ray.before_t = 0;
    ray.before_distance = scene.end;
    ray.steps = 0;
    ray.de_calls = 0;
    ray.iterations = 0;
    return ray;
}

FN Ray begin_along(Scene scene, vec3 direction) { return begin_inside(scene, scene.hull, direction); }

// Returns the direction through (u, v) of the picture, not normalised; v = -1 is the bottom.
FN vec3 direction_at(Scene scene, real u, real v)
{
    vec3 direction = perspective(scene, u, v);
    if (scene.longitudes > 0) direction = equirectangular(scene, u, v);
    return direction;
}

FN Ray begin_at(Scene scene, real u, real v) { return begin_along(scene, direction_at(scene, u, v)); }

// Begins the ray through pixel (i, j); j = 0 is the bottom row.
FN Ray begin(Scene scene, real i, real j)
{
    return begin_at(scene, picture_place(i, scene.width), picture_place(j, scene.height));
}

// Returns the tolerance at the last sample. The sample is a hit if its estimate is below the tolerance. The original
// stepping computes the tolerance from the t after the step, canonical pictures from the t of the sample.
FN real tolerance(Scene scene, Ray ray)
{
    real t = ray.t;
    if (scene.canonical != 0) t = ray.last_t;
    return t * scene.tolerance;
}

// Returns true while the ray has neither hit nor left the scene, and has steps left.
FN mask marching(Scene scene, Ray ray)
{
    return ray.last_distance > tolerance(scene, ray) && ray.t <= ray.end && ray.steps < scene.max_steps;
}

FN mask has_hit(Scene scene, Ray ray) { return ray.last_distance < tolerance(scene, ray); }

FN vec3 point_at(Scene scene, Ray ray, real t) { return along(splat(scene.eye), ray.direction, t); }

// Returns the estimate at the ray's next sample. This function is separate from advanced(), so that a backend can
// evaluate DE for more rays at once than it processes in other functions.
FN Estimate probe(Scene scene, Ray ray, mask on) { return estimate(scene, point_at(scene, ray, ray.t), on); }

// Takes one step of sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996) with over-relaxation (Keinert
// et al., "Enhanced sphere tracing", STAG 2014), for the active rays. A relaxed step is longer than the estimate. It is
// retracted if the spheres at its two ends do not overlap.
FN Ray advanced(Scene scene, Ray ray, Estimate here, mask on)
{
    real reach = ray.t - ray.last_t;
    mask over = reach > ray.last_distance && here.distance + ray.last_distance < reach;
    mask taken = on && !over;
    ray.before_t = pick(taken, ray.last_t, ray.before_t);
    ray.before_distance = pick(taken, ray.last_distance, ray.before_distance);
    ray.last_t = pick(taken, ray.t, ray.last_t);
    ray.last_distance = pick(taken, here.distance, ray.last_distance);
    real step = scene.step_factor;
    if (scene.relaxation > scene.step_factor) step = pick(over, scene.step_factor, relaxed(scene, ray));
    ray.t = pick(on, ray.last_t + step * ray.last_distance, ray.t);
    ray.steps = ray.steps + count(on);
    ray.de_calls = tally(ray.de_calls, on);
    ray.iterations = ray.iterations + here.iterations;
    return ray;
}

FN Ray advance(Scene scene, Ray ray, mask on) { return advanced(scene, ray, probe(scene, ray, on), on); }

// Advances every marching ray by at most `steps` steps.
FN Ray march(Scene scene, Ray ray, int steps)
{
    mask on = marching(scene, ray);
    int i = 0;
    while (i < steps && any(on)) {
        ray = advance(scene, ray, on);
        on = marching(scene, ray);
        i = i + 1;
    }
    return ray;
}
