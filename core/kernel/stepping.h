// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 6: how long a ray's next step is. core/render/stepping.h has what is decided before a picture is
// drawn, docs/fast-mode.md the reasons.

// Chosen by how far pictures of random scenes change (docs/notes/experiments.md).
FN scalar shortest_relaxed() { return R(1.2); }  // of an over-relaxed step, in distance estimates
FN scalar dip_margin() { return R(1.3); }        // where DE is less than so many tolerances a step is a dip's
FN scalar dip_stride() { return R(0.4); }        // of such a step, in distance estimates
FN scalar aimed_tolerance() { return R(0.9); }   // the estimate that a film's step aims at, in tolerances
FN scalar shortest_aimed() { return R(0.2); }    // of a film's step, in distance estimates
FN scalar neighbour_margin() { return R(0.1); }  // before the nearest of four neighbours, in the range of their depths
FN int most_cone_steps() { return 100; }         // then the cone ends, and its rays go on alone

// The step from the last sample, in estimates. Were DE to go on changing as between the last two samples, 2 / (1 -
// slope) is where the spheres of a step's ends just touch (Ban and Valasek, "Automatic step size relaxation in sphere
// tracing", Eurographics 2023); somewhat less misses less. Where DE is little more than the tolerance a dip below it is
// most easily stepped over: short steps there (docs/fast-mode.md, "Steps").
FN real relaxed(Scene scene, Ray ray)
{
    real way = ray.last_t - ray.before_t;
    real fall = larger(ray.before_distance - ray.last_distance, 0);  // -slope * way
    real factor = larger(rough_quotient(scene.relaxation * way, way + fall), shortest_relaxed());
    real step = pick(ray.last_distance > dip_margin() * scene.tolerance * ray.last_t, factor, dip_stride());
    if (scene.differences == 2) {
        // A film's pictures: to where the estimate is a little less than the tolerance, were it to go on falling as
        // before. Longer steps end behind the surface, and finding it again takes samples.
        real wanted = ray.last_distance - aimed_tolerance() * scene.tolerance * ray.last_t;
        real aimed = rough_quotient(wanted * way, smaller(fall, way) * ray.last_distance);
        step = smaller(factor, larger(aimed, shortest_aimed()));
    }
    return step;
}

// Neighbours: pixels that are drawn before those between them. What a neighbour's ray leaves for these is its depth: t
// of its hit; clear_miss() where it missed with room on all sides; unclear_miss() elsewhere.
FN scalar clear_miss() { return R(-1.0); }
FN scalar unclear_miss() { return R(0.0); }

// No ray gets there.
FN scalar beyond_scene(Scene scene) { return 2 * scene.end; }

// Where a ray between four neighbours begins, by the least and the greatest of their depths: before all of their hits,
// by a tolerance and a tenth of how far they lie apart; beyond the scene where all missed clearly; else at 0, alone.
// (Something thin may stand between them: docs/fast-mode.md. For fast mode.)
FN real neighbour_start(Scene scene, real least, real greatest)
{
    real start = least - neighbour_margin() * (greatest - least) - scene.tolerance * least;
    return pick(least > 0, start, pick(greatest < 0, beyond_scene(scene), 0));
}
