// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 6: the length of a ray's next step. core/render/stepping.h sets the parameters of a picture;
// docs/fast-mode.md explains the method.

// Chosen by the changes of pictures of random scenes (docs/notes/experiments.md).
FN scalar shortest_relaxed() { return R(1.2); }  // min over-relaxed step, in distance estimates
FN scalar dip_margin() { return R(1.3); }        // DE below this many tolerances: the step is a dip's
FN scalar dip_stride() { return R(0.4); }        // step in a dip, in distance estimates
FN scalar aimed_tolerance() { return R(0.9); }   // estimate at which a film's step aims, in tolerances
FN scalar shortest_aimed() { return R(0.2); }    // min step of a film, in distance estimates
FN scalar neighbour_margin() { return R(0.1); }  // gap before the nearest of four neighbours, in ranges of depth
FN int most_cone_steps() { return 100; }         // max steps of a cone; its rays then continue one by one

// The step from the last sample, in estimates. If DE keeps its slope between the last two samples, the spheres at the
// ends of a step touch at 2 / (1 - slope) (Ban and Valasek, "Automatic step size relaxation in sphere tracing",
// Eurographics 2023); a slightly shorter step overshoots less often. If DE is only slightly above the tolerance, a step
// can easily miss a dip below it, so steps are short there (docs/fast-mode.md, "Steps").
FN real relaxed(Scene scene, Ray ray)
{
    real way = ray.last_t - ray.before_t;
    real fall = larger(ray.before_distance - ray.last_distance, 0);  // -slope * way
    real factor = larger(rough_quotient(scene.relaxation * way, way + fall), shortest_relaxed());
    real step = pick(ray.last_distance > dip_margin() * scene.tolerance * ray.last_t, factor, dip_stride());
    if (scene.differences == 2) {
        // Films: aims at the point where the estimate, with the same slope, falls slightly below the tolerance. Longer
        // steps end behind the surface, and returning to it costs samples.
        real wanted = ray.last_distance - aimed_tolerance() * scene.tolerance * ray.last_t;
        real aimed = rough_quotient(wanted * way, smaller(fall, way) * ray.last_distance);
        step = smaller(factor, larger(aimed, shortest_aimed()));
    }
    return step;
}

// Neighbours: pixels rendered before the pixels between them. A neighbour passes on its depth: t of its hit;
// clear_miss() for a miss with clearance on all sides; unclear_miss() otherwise.
FN scalar clear_miss() { return R(-1.0); }
FN scalar unclear_miss() { return R(0.0); }

// Larger than any t of a ray.
FN scalar beyond_scene(Scene scene) { return 2 * scene.end; }

// Returns the t at which a ray between four neighbours begins, from the min and max of their depths: before all four
// hits, by a tolerance and a tenth of the range; beyond the scene if all four missed clearly; otherwise 0. Fast mode
// only, as a thin feature between the neighbours is missed (docs/fast-mode.md).
FN real neighbour_start(Scene scene, real least, real greatest)
{
    real start = least - neighbour_margin() * (greatest - least) - scene.tolerance * least;
    return pick(least > 0, start, pick(greatest < 0, beyond_scene(scene), 0));
}
