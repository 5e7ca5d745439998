// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 6: a ray from the camera to its hit. begin -> march (any number of times) -> refine.

// Where pixel number `at` of `size` in a row or a column lies in the picture, from -1 to 1. The last bits show.
FN real picture_place(real at, scalar size) { return quotient(2 * at, size) - 1; }

// The ray through (u, v) of the picture; v = -1 is the bottom.
FN Ray begin_at(Scene scene, real u, real v)
{
    Ray ray;
    ray.direction = unit(along(along(wide(scene.forward), wide(scene.across), u), wide(scene.upward), v));
    ray.end = scene.end;
    ray.t = 0;
    if (scene.hull > 0) {
        Span span = hull(scene, wide(scene.eye), ray.direction);
        // Rounding moves the far end by less than this.
        ray.end = smaller(ray.end, span.last * R(1.0001));
        ray.end = pick(span.first <= span.last, larger(ray.end, -1), R(-1.0));
        // The plain schedule's samples start at the eye.
        if (scene.canonical != 0) ray.t = larger(span.first * R(0.9999), 0);
    }
    ray.last_t = 0;
    ray.last_distance = scene.end;  // larger than the tolerance of any first sample, so that the march begins
    ray.before_t = 0;
    ray.before_distance = scene.end;
    ray.steps = 0;
    ray.estimates = 0;
    ray.iterations = 0;
    return ray;
}

// The ray through pixel (i, j); j = 0 is the bottom row.
FN Ray begin(Scene scene, real i, real j)
{
    return begin_at(scene, picture_place(i, scene.width), picture_place(j, scene.height));
}

// The estimate below which the last sample is a hit. The plain schedule takes the t after the step.
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

FN vec3 point_at(Scene scene, Ray ray, real t) { return along(wide(scene.eye), ray.direction, t); }

// The step from the last sample, in estimates. Were DE to go on changing as between the last two samples, 2 / (1 -
// slope) is where the spheres of a step's ends just touch (Ban and Valasek, "Automatic step size relaxation in sphere
// tracing", Eurographics 2023); somewhat less misses less. Where DE is little more than the tolerance a dip below it is
// most easily stepped over: short steps there (docs/fast-mode.md, "Steps").
FN real relaxed(Scene scene, Ray ray)
{
    real way = ray.last_t - ray.before_t;
    real fall = larger(ray.before_distance - ray.last_distance, 0);  // -slope * way
    real factor = larger(rough_quotient(scene.relaxation * way, way + fall), R(1.2));
    return pick(ray.last_distance > R(1.3) * scene.tolerance * ray.last_t, factor, R(0.4));
}

// The ray's next sample. What steps do with a sample are functions of their own, so that a backend can take samples of
// more rays at once than it handles otherwise.
FN Estimate probe(Scene scene, Ray ray, mask on) { return estimate(scene, point_at(scene, ray, ray.t), on); }

// One step of sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996) for the rays that are on, with
// over-relaxation (Keinert et al., "Enhanced sphere tracing", STAG 2014): a step longer than the estimate is taken back
// where the spheres of its two ends do not overlap.
FN Ray advanced(Scene scene, Ray ray, Estimate here, mask on)
{
    real reach = ray.t - ray.last_t;
    mask over = reach > ray.last_distance && here.distance + ray.last_distance < reach;
    mask taken = on && !over;
    ray.before_t = pick(taken, ray.last_t, ray.before_t);
    ray.before_distance = pick(taken, ray.last_distance, ray.before_distance);
    ray.last_t = pick(taken, ray.t, ray.last_t);
    ray.last_distance = pick(taken, here.distance, ray.last_distance);
    real step = scene.stride;
    if (scene.relaxation > scene.stride) step = pick(over, scene.stride, relaxed(scene, ray));
    ray.t = pick(on, ray.last_t + step * ray.last_distance, ray.t);
    ray.steps = ray.steps + count(on);
    ray.estimates = tally(ray.estimates, on);
    ray.iterations = ray.iterations + here.iterations;
    return ray;
}

FN Ray advance(Scene scene, Ray ray, mask on) { return advanced(scene, ray, probe(scene, ray, on), on); }

// A cone of rays, at most `width` apart from its axis at distance 1, goes as far as none of them can hit: within the
// sphere of radius DE around a point of its axis DE is at least what is left of that radius. (Fractal distance
// estimates can change faster than the distance, so that this is for fast mode.)
FN real cone_gap(Scene scene, Ray ray, real distance, scalar width)
{
    return quick_quotient(distance - (width + scene.tolerance) * ray.t, 1 + width + scene.tolerance);
}

// A cone's step, relaxed as a ray's: its gap takes the estimate's place. `last_distance` becomes 0 where it ends, as a
// step would be short beside its own width.
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

// True while the cone has not ended. What a hundred steps do not reach rays go alone.
FN mask cone_goes(Ray ray) { return ray.last_distance > 0 && ray.t <= ray.end && ray.steps < 100; }

// Neighbours: pixels that are drawn before those between them. What a neighbour's ray leaves for these is its depth: t of
// its hit; clear_miss() where it missed with room on all sides; unclear_miss() elsewhere.
FN scalar clear_miss() { return R(-1.0); }
FN scalar unclear_miss() { return R(0.0); }

// No ray gets there.
FN scalar beyond_scene(Scene scene) { return 2 * scene.end; }

// Where a ray between four neighbours begins, by the least and the greatest of their depths: before all of their hits, by
// a tolerance and a quarter of how far they lie apart; beyond the scene where all missed clearly; else at 0, alone.
// (Something thin may stand between them: docs/fast-mode.md. For fast mode.)
FN real neighbour_start(Scene scene, real least, real greatest)
{
    real start = least - R(0.25) * (greatest - least) - scene.tolerance * least;
    return pick(least > 0, start, pick(greatest < 0, beyond_scene(scene), 0));
}

// Begins a ray there.
FN Ray begun_by_neighbours(Ray ray, real start)
{
    ray.last_t = pick(start > ray.t, ray.t, 0);
    ray.t = larger(start, ray.t);
    return ray;
}

// True where the first sample is a hit after all: the ray begins again, alone.
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

// At most `steps` steps of every ray that is still marching.
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

// The canonical hit: the root of f(t) = DE(t) - tolerance t between the last two samples, by the method of Anderson and
// Bjorck (BIT 13, 1973): a secant's root, and a share of the value of an end that stays. While a ray is refined,
// its samples are the bracket: f > 0 at before_t, f < 0 at last_t, with f in place of the distances; t is the last root
// tried. Its `end` has become a note of how far refinement is; while marching, it is -1 or more.
FN real none_tried() { return -2; }
FN real tried_below() { return -3; }  // the last root tried lies below the surface, f < 0
FN real tried_above() { return -4; }
FN real no_root() { return -5; }  // there is no hit, or a first sample hit, or no number is left between the ends

// Changes what has not begun yet.
FN Ray refine_begin(Scene scene, Ray ray)
{
    mask fresh = ray.end >= -1;
    mask hit = has_hit(scene, ray);
    real below = pick(hit, ray.last_distance - scene.tolerance * ray.last_t, scene.end);
    real above = ray.before_distance - scene.tolerance * ray.before_t;
    ray.end = pick(fresh, pick(hit && ray.last_t > ray.before_t, none_tried(), no_root()), ray.end);
    ray.last_distance = pick(fresh, below, ray.last_distance);
    ray.before_distance = pick(fresh, above, ray.before_distance);
    ray.t = pick(fresh, ray.last_t, ray.t);
    return ray;
}

// A root is good where f is a small share of the tolerance: one more secant then brings it closer still.
FN mask refining(Scene scene, Ray ray)
{
    real narrow = scene.root_share * scene.tolerance * ray.last_t;
    real f = pick(ray.end == tried_above(), ray.before_distance, ray.last_distance);
    return ray.end > no_root() && magnitude(f) > narrow && ray.last_t - ray.before_t > narrow;
}

FN real secant(Ray ray)
{
    real rise = ray.last_distance - ray.before_distance;
    return ray.last_t - quick_quotient(ray.last_distance * (ray.last_t - ray.before_t), rise);
}

FN mask in_bracket(Ray ray, real t) { return t > ray.before_t && t < ray.last_t; }

// Where the next root is tried; none is where no number is left between the ends.
FN Ray aimed(Ray ray, mask on)
{
    real t = secant(ray);
    t = pick(in_bracket(ray, t), t, R(0.5) * (ray.before_t + ray.last_t));
    ray.end = pick(on && !in_bracket(ray, t), no_root(), ray.end);
    ray.t = pick(on && ray.end > no_root(), t, ray.t);
    return ray;
}

// What the root that was tried tells.
FN Ray narrowed(Scene scene, Ray ray, Estimate here, mask on)
{
    real f = here.distance - scene.tolerance * ray.t;
    mask below = on && f < 0;
    mask above = on && !below;
    // An end that stays a second time counts by how far the other one fell, or half.
    real share = 1 - rough_quotient(f, pick(below, ray.last_distance, ray.before_distance));
    share = pick(share > 0, share, R(0.5));
    mask twice_below = below && ray.end == tried_below();
    mask twice_above = above && ray.end == tried_above();
    ray.before_distance = pick(twice_below, share * ray.before_distance, ray.before_distance);
    ray.last_distance = pick(twice_above, share * ray.last_distance, ray.last_distance);
    ray.before_t = pick(above, ray.t, ray.before_t);
    ray.before_distance = pick(above, f, ray.before_distance);
    ray.last_t = pick(below, ray.t, ray.last_t);
    ray.last_distance = pick(below, f, ray.last_distance);
    ray.end = pick(on, pick(below, tried_below(), tried_above()), ray.end);
    ray.estimates = tally(ray.estimates, on);
    ray.iterations = ray.iterations + here.iterations;
    return ray;
}

// At most `steps` roots tried, after which it can go on in another pass.
FN Ray refine_by(Scene scene, Ray ray, int steps)
{
    ray = refine_begin(scene, ray);
    mask on = refining(scene, ray);
    int i = 0;
    while (i < steps && any(on)) {
        ray = aimed(ray, on);
        on = on && ray.end > no_root();
        ray = narrowed(scene, ray, probe(scene, ray, on), on);
        on = on && refining(scene, ray);
        i = i + 1;
    }
    return ray;
}

// All of it: the method takes some five steps, and 100 are enough where f jumps.
FN Ray refine(Scene scene, Ray ray) { return refine_by(scene, ray, 100); }

// Where a ray that has hit meets the surface.
FN real landing(Scene scene, Ray ray)
{
    real t = ray.last_t;
    if (scene.canonical != 0) {
        // One more secant's root, which costs no estimate.
        real closer = secant(ray);
        t = pick(ray.end > no_root() && in_bracket(ray, closer), closer, ray.t);
    }
    return t;
}
