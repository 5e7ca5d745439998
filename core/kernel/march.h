// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 8: a ray from the camera until it hits or leaves the scene. begin -> march (repeatable).

// Begins a ray from the camera; the direction may have any length.
FN Ray begin_along(Scene scene, vec3 direction)
{
    Ray ray;
    ray.direction = unit(direction);
    ray.end = scene.end;
    ray.t = 0;
    if (scene.hull > 0) {
        Span span = hull(scene, splat(scene.eye), ray.direction);
        // The margin exceeds the rounding error of the far end.
        ray.end = smaller(ray.end, span.last * R(1.0001));
        ray.end = pick(span.first <= span.last, larger(ray.end, -1), R(-1.0));
        // The original stepping takes its first sample at the eye.
        if (scene.canonical != 0) ray.t = larger(span.first * R(0.9999), 0);
    }
    ray.last_t = 0;
    ray.last_distance = scene.end;  // above the tolerance of any first sample, so that the march begins
    ray.before_t = 0;
    ray.before_distance = scene.end;
    ray.steps = 0;
    ray.de_calls = 0;
    ray.iterations = 0;
    return ray;
}

// Begins the ray through (u, v) of the picture; v = -1 is the bottom.
FN Ray begin_at(Scene scene, real u, real v)
{
    vec3 direction = perspective(scene, u, v);
    if (scene.longitudes > 0) direction = equirectangular(scene, u, v);
    return begin_along(scene, direction);
}

// Begins the ray through pixel (i, j); j = 0 is the bottom row.
FN Ray begin(Scene scene, real i, real j)
{
    return begin_at(scene, picture_place(i, scene.width), picture_place(j, scene.height));
}

// The last sample is a hit if its estimate is below this. The original stepping uses t after the step.
FN real tolerance(Scene scene, Ray ray)
{
    real t = ray.t;
    if (scene.canonical != 0) t = ray.last_t;
    return t * scene.tolerance;
}

// True while the ray has neither hit nor left the scene.
FN mask marching(Scene scene, Ray ray)
{
    return ray.last_distance > tolerance(scene, ray) && ray.t <= ray.end && ray.steps < scene.max_steps;
}

FN mask has_hit(Scene scene, Ray ray) { return ray.last_distance < tolerance(scene, ray); }

FN vec3 point_at(Scene scene, Ray ray, real t) { return along(splat(scene.eye), ray.direction, t); }

// Evaluates DE at the next sample. Separate from advanced(), so that a backend can evaluate more rays at once than it
// otherwise processes.
FN Estimate probe(Scene scene, Ray ray, mask on) { return estimate(scene, point_at(scene, ray, ray.t), on); }

// One step of sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996) for the active rays, with
// over-relaxation (Keinert et al., "Enhanced sphere tracing", STAG 2014): a step longer than the estimate is retracted
// if the spheres at its ends do not overlap.
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

// A cone holds rays up to `width` from its axis at distance 1 and advances while none of them can hit: inside the
// sphere of radius DE around a point of the axis, DE is at least the distance to that sphere. Fractal distance
// estimates can change faster than the distance, so cones are used in fast mode only.
FN real cone_gap(Scene scene, Ray ray, real distance, scalar width)
{
    return quick_quotient(distance - (width + scene.tolerance) * ray.t, 1 + width + scene.tolerance);
}

// One step of a cone, relaxed as for a ray, with the gap instead of the estimate. Sets `last_distance` to 0 when the
// cone ends, that is, when a step would be short compared with the cone's width.
FN Ray advanced_cone(Scene scene, Ray ray, scalar width, Estimate here, mask on)
{
    real t = ray.t;
    here.distance = cone_gap(scene, ray, here.distance, width);
    mask narrow = here.distance <= width * t;
    ray = advanced(scene, ray, here, on);
    mask ended = on && narrow && ray.last_t == t;
    ray.last_distance = pick(ended, 0, ray.last_distance);
    ray.t = pick(ended, t, ray.t);
    return ray;
}

// True while the cone has clearance, is in the scene and has steps left.
FN mask cone_goes(Ray ray) { return ray.last_distance > 0 && ray.t <= ray.end && ray.steps < most_cone_steps(); }

// Begins a ray at neighbour_start().
FN Ray begun_by_neighbours(Ray ray, real start)
{
    ray.last_t = pick(start > ray.t, ray.t, 0);
    ray.t = larger(start, ray.t);
    return ray;
}

// True if the first sample after neighbour_start() is already a hit: the ray must begin again from its own start.
FN mask begun_too_late(Scene scene, Ray ray)
{
    return has_hit(scene, ray) && ray.before_t > 0 && ray.before_distance == scene.end;
}

FN Ray begun_alone(Scene scene, Ray ray, mask on)
{
    ray.t = pick(on, ray.before_t, ray.t);
    ray.last_t = pick(on, 0, ray.last_t);
    ray.last_distance = pick(on, scene.end, ray.last_distance);
    ray.before_t = pick(on, 0, ray.before_t);
    return ray;
}

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
