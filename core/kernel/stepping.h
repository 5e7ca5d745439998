// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 6: computes the length of a ray's next step. core/render/stepping.h sets the parameters of a
// picture, and docs/fast-mode.md explains the method.

// Constants, chosen by measuring how much pictures of random scenes change (docs/notes/experiments.md).
FN scalar shortest_relaxed() { return R(1.2); }  // min length of an over-relaxed step, as a multiple of the estimate
FN scalar dip_margin() { return R(1.3); }        // an estimate below this many tolerances is close to a dip
FN scalar dip_stride() { return R(0.4); }        // length of a step there, as a multiple of the estimate
FN scalar aimed_tolerance() { return R(0.9); }   // estimate at which a step of a film aims, in tolerances
FN scalar shortest_aimed() { return R(0.2); }    // min length of a step of a film, as a multiple of the estimate
FN scalar neighbour_margin() { return R(0.1); }  // gap before the nearest of four hits, as a fraction of their range
FN int most_cone_steps() { return 100; }         // max steps of a cone; after them its rays march individually

// Returns the length of the step from the last sample, as a multiple of the estimate there. If DE continues with the
// slope that it has between the last two samples, the spheres at the two ends of a step touch if its length is 2 / (1
// - slope) (Ban and Valasek, "Automatic step size relaxation in sphere tracing", Eurographics 2023). A slightly
// shorter step is retracted less often. If the estimate is only slightly above the tolerance, a long step can easily
// pass a dip in which DE is below the tolerance, so steps are short there (docs/fast-mode.md, "Steps").
FN real relaxed(Scene scene, Ray ray)
{
    real way = ray.last_t - ray.before_t;
    real fall = larger(ray.before_distance - ray.last_distance, 0);  // equals -slope * way
    real factor = larger(rough_quotient(scene.relaxation * way, way + fall), shortest_relaxed());
    real step = pick(ray.last_distance > dip_margin() * scene.tolerance * ray.last_t, factor, dip_stride());
    if (scene.differences == 2) {
        // In films, a step aims at the point where the estimate, continued with the same slope, falls slightly below
        // the tolerance. A longer step would end behind the surface, and returning from there costs samples.
        real wanted = ray.last_distance - aimed_tolerance() * scene.tolerance * ray.last_t;
        real aimed = rough_quotient(wanted * way, smaller(fall, way) * ray.last_distance);
        step = smaller(factor, larger(aimed, shortest_aimed()));
    }
    return step;
}

// Neighbours are pixels that are rendered before the pixels between them. A neighbour passes on a depth to these
// pixels: the t of its hit; clear_miss() if its ray missed with enough clearance for the rays around it; or
// unclear_miss() for other misses.
FN scalar clear_miss() { return R(-1.0); }
FN scalar unclear_miss() { return R(0.0); }

// Returns a t that is larger than any t of a ray.
FN scalar beyond_scene(Scene scene) { return 2 * scene.end; }

// Returns the t at which a ray between four neighbours begins, from the min and the max of their depths. If all four
// hit, the ray begins in front of the nearest of these hits, by one tolerance and a tenth of the range of the depths.
// If all four missed clearly, it begins beyond the scene; otherwise at 0. Used in fast mode only, because a thin
// feature between the neighbours can be missed (docs/fast-mode.md).
FN real neighbour_start(Scene scene, real least, real greatest)
{
    real start = least - neighbour_margin() * (greatest - least) - scene.tolerance * least;
    return pick(least > 0, start, pick(greatest < 0, beyond_scene(scene), 0));
}
