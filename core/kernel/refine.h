// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 10: finds the point on the surface that a stopped ray has hit. Call order: stopped(); refine()
// any number of times, only for canonical pictures; landing(). The canonical hit is the root of f(t) = DE(t) -
// tolerance t between the ray's last two samples, which are the first bracket.

// Values of Hit::state.
FN real no_hit() { return 0; }       // the ray has left the scene or used all its steps
FN real settled() { return 1; }      // t is final: the picture is not canonical, or the bracket is missing or empty
FN real untried() { return 2; }      // the hit has not been refined yet
FN real tried_below() { return 3; }  // the last refinement evaluated a point below the surface (f < 0)
FN real tried_above() { return 4; }  // the last refinement evaluated a point above the surface (f >= 0)

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

// Returns true while both |f| and the bracket's length exceed a small fraction of the tolerance. After the refinement,
// landing() takes one more secant, whose t is still more accurate.
FN mask refining(Scene scene, Hit hit)
{
    real narrow = scene.root_share * scene.tolerance * hit.below_t;
    real f = pick(hit.state == tried_above(), hit.above_f, hit.below_f);
    return hit.state > settled() && magnitude(f) > narrow && hit.below_t - hit.above_t > narrow;
}

// Returns the root of the secant through the ends of the bracket. Refinement is the regula falsi of Anderson and Bjorck
// (BIT 13, 1973): narrowed() scales down f at an end that is retained repeatedly.
FN real secant(Hit hit)
{
    real rise = hit.below_f - hit.above_f;
    return hit.below_t - quick_quotient(hit.below_f * (hit.below_t - hit.above_t), rise);
}

FN mask in_bracket(Hit hit, real t) { return t > hit.above_t && t < hit.below_t; }

// Sets hit.t to the next t to evaluate. If there is no number between the ends of the bracket, the hit is settled.
FN Hit aimed(Hit hit, mask on)
{
    real t = secant(hit);
    t = pick(in_bracket(hit, t), t, R(0.5) * (hit.above_t + hit.below_t));
    hit.state = pick(on && !in_bracket(hit, t), settled(), hit.state);
    hit.t = pick(on && hit.state > settled(), t, hit.t);
    return hit;
}

// Evaluates DE at hit.t.
FN Estimate probe_root(Scene scene, Hit hit, mask on)
{
    return estimate(scene, along(splat(scene.eye), hit.direction, hit.t), on);
}

// Narrows the bracket with `here`, the estimate at hit.t.
FN Hit narrowed(Scene scene, Hit hit, Estimate here, mask on)
{
    real f = here.distance - scene.tolerance * hit.t;
    mask below = on && f < 0;
    mask above = on && !below;
    // If an end of the bracket is retained for the second time, its f is scaled down by a factor. The factor is 1 minus
    // the ratio of the new f to the old f at the other end, or one half if this is not positive.
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

// Refines hits at most `tries` times. A later pass can continue the refinement.
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

// Returns the max number of refinements. Usually about five are needed; one hundred are enough where f jumps.
FN int most_tries() { return 100; }

FN Hit refine(Scene scene, Hit hit) { return refine_by(scene, hit, most_tries()); }

// Returns the t at which the ray meets the surface.
FN real landing(Scene scene, Hit hit)
{
    real t = hit.below_t;
    if (scene.canonical != 0) {
        // Takes one more secant, without a DE evaluation.
        real closer = secant(hit);
        t = pick(hit.state > settled() && in_bracket(hit, closer), closer, hit.t);
    }
    return t;
}
