// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 9: from a stopped ray to its point on the surface. stopped -> refine (repeatable, canonical
// pictures only) -> landing. The canonical hit is the root of f(t) = DE(t) - tolerance t between the last two samples.

// States of a Hit.
FN real no_hit() { return 0; }       // the ray has left the scene or used all its steps
FN real settled() { return 1; }      // t is the hit: not canonical, without a bracket, or with an empty one
FN real untried() { return 2; }      // not refined yet
FN real tried_below() { return 3; }  // the last refinement lies below the surface
FN real tried_above() { return 4; }  // the last refinement lies above it

FN mask is_hit(Hit hit) { return hit.state > no_hit(); }

FN Hit stopped(Scene scene, Ray ray)
{
    mask found = has_hit(scene, ray);
    Hit hit;
    hit.direction = ray.direction;
    hit.state = pick(found, settled(), no_hit());
    hit.t = ray.t;
    hit.below_t = ray.last_t;
    hit.below_f = 0;
    hit.above_t = ray.before_t;
    hit.above_f = 0;
    if (scene.canonical != 0) {
        hit.state = pick(found && ray.last_t > ray.before_t, untried(), hit.state);
        hit.t = ray.last_t;
        hit.below_f = ray.last_distance - scene.tolerance * ray.last_t;
        hit.above_f = ray.before_distance - scene.tolerance * ray.before_t;
    }
    hit.steps = ray.steps;
    hit.de_calls = ray.de_calls;
    hit.iterations = ray.iterations;
    return hit;
}

// True while |f| and the bracket exceed a small fraction of the tolerance. landing() adds a secant, which is closer
// still.
FN mask refining(Scene scene, Hit hit)
{
    real narrow = scene.root_share * scene.tolerance * hit.below_t;
    real f = pick(hit.state == tried_above(), hit.above_f, hit.below_f);
    return hit.state > settled() && magnitude(f) > narrow && hit.below_t - hit.above_t > narrow;
}

// Regula falsi of Anderson and Bjorck (BIT 13, 1973): f at a retained end is scaled down.
FN real secant(Hit hit)
{
    real rise = hit.below_f - hit.above_f;
    return hit.below_t - quick_quotient(hit.below_f * (hit.below_t - hit.above_t), rise);
}

FN mask in_bracket(Hit hit, real t) { return t > hit.above_t && t < hit.below_t; }

// Sets the next t to evaluate; the hit is settled if no number lies between the ends of the bracket.
FN Hit aimed(Hit hit, mask on)
{
    real t = secant(hit);
    t = pick(in_bracket(hit, t), t, R(0.5) * (hit.above_t + hit.below_t));
    hit.state = pick(on && !in_bracket(hit, t), settled(), hit.state);
    hit.t = pick(on && hit.state > settled(), t, hit.t);
    return hit;
}

// Evaluates DE at that t.
FN Estimate probe_root(Scene scene, Hit hit, mask on)
{
    return estimate(scene, along(splat(scene.eye), hit.direction, hit.t), on);
}

// Narrows the bracket with that estimate.
FN Hit narrowed(Scene scene, Hit hit, Estimate here, mask on)
{
    real f = here.distance - scene.tolerance * hit.t;
    mask below = on && f < 0;
    mask above = on && !below;
    // An end retained twice is scaled by the relative decrease of the other end, or by one half.
    real share = 1 - rough_quotient(f, pick(below, hit.below_f, hit.above_f));
    share = pick(share > 0, share, R(0.5));
    mask twice_below = below && hit.state == tried_below();
    mask twice_above = above && hit.state == tried_above();
    hit.above_f = pick(twice_below, share * hit.above_f, hit.above_f);
    hit.below_f = pick(twice_above, share * hit.below_f, hit.below_f);
    hit.above_t = pick(above, hit.t, hit.above_t);
    hit.above_f = pick(above, f, hit.above_f);
    hit.below_t = pick(below, hit.t, hit.below_t);
    hit.below_f = pick(below, f, hit.below_f);
    hit.state = pick(on, pick(below, tried_below(), tried_above()), hit.state);
    hit.de_calls = tally(hit.de_calls, on);
    hit.iterations = hit.iterations + here.iterations;
    return hit;
}

// Refines at most `tries` times; another pass can continue.
FN Hit refine_by(Scene scene, Hit hit, int tries)
{
    mask on = refining(scene, hit);
    int i = 0;
    while (i < tries && any(on)) {
        hit = aimed(hit, on);
        on = on && hit.state > settled();
        hit = narrowed(scene, hit, probe_root(scene, hit, on), on);
        on = on && refining(scene, hit);
        i = i + 1;
    }
    return hit;
}

// Max refinements: the method needs about five; a hundred suffice where f jumps.
FN int most_tries() { return 100; }

FN Hit refine(Scene scene, Hit hit) { return refine_by(scene, hit, most_tries()); }

// Returns the t at which the ray meets the surface.
FN real landing(Scene scene, Hit hit)
{
    real t = hit.below_t;
    if (scene.canonical != 0) {
        // One more secant, without a DE evaluation.
        real closer = secant(hit);
        t = pick(hit.state > settled() && in_bracket(hit, closer), closer, hit.t);
    }
    return t;
}
