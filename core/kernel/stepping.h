// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 6: how long a ray's next step is. core/render/stepping.h has what is decided before a picture is
// drawn, docs/fast-mode.md the reasons.

// Chosen by how far pictures of random scenes change (docs/notes/experiments.md).
FN scalar shortest_relaxed() { return R(1.2); }  // of an over-relaxed step, in distance estimates
FN scalar dip_margin() { return R(1.3); }        // where DE is less than so many tolerances a step is a dip's
FN scalar dip_stride() { return R(0.4); }        // of such a step, in distance estimates
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
    return pick(ray.last_distance > dip_margin() * scene.tolerance * ray.last_t, factor, dip_stride());
}
