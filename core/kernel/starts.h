// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 9: finds where the rays of fast pictures can begin. A cone around the rays of a tile finds how
// far all of them can advance together. Hits of pixels that are already rendered, the neighbours, show where the
// surface is near a ray (docs/fast-mode.md, "Cones and neighbours").

// Returns how far a cone can advance without any of its rays hitting. A cone contains the rays whose distance from its
// axis is at most `width` at distance 1 from the camera. A point whose distance from a point of the axis is less than
// the estimate there cannot be on the surface. Estimates of fractals can change faster than the distance, so cones are
// used in fast mode only.
FN real cone_gap(Scene scene, Ray ray, real distance, scalar width)
{
    return quick_quotient(distance - (width + scene.tolerance) * ray.t, 1 + width + scene.tolerance);
}

// Takes one step of a cone. It is relaxed like a ray's step, and uses the gap instead of the estimate. When the step
// would be shorter than the cone is wide, the cone ends, and `last_distance` is set to 0.
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

// Returns true while the cone has not ended, is in the scene, and has steps left.
FN mask cone_goes(Ray ray) { return ray.last_distance > 0 && ray.t <= ray.end && ray.steps < most_cone_steps(); }

// Begins the cone around the rays of `side` x `side` pixels, at most a subtile, of which (i, j) is the lowest left.
FN Ray begin_cone(Scene scene, real i, real j, scalar side)
{
    scalar middle = R(0.5) * (side - 1);
    real u = picture_place(i + middle, scene.width);
    real v = picture_place(j + middle, scene.height);
    return begin_inside(scene, scene.subtile_hull, direction_at(scene, u, v));
}

// Returns the width of that cone, for advanced_cone().
FN scalar cone_width(Scene scene, scalar side) { return scene.spacing * (R(0.5) * (side - 1)); }

// Marches cones to their ends.
FN Ray march_cone(Scene scene, Ray ray, scalar width)
{
    mask on = cone_goes(ray);
    while (any(on)) {
        ray = advanced_cone(scene, ray, width, probe(scene, ray, on), on);
        on = on && cone_goes(ray);
    }
    return ray;
}

// Returns the t at which the rays of a cone that has ended can begin.
FN real cone_end(Scene scene, Ray ray) { return pick(ray.t <= ray.end, ray.t, beyond_scene(scene)); }

// Moves the beginning of a ray to `start`, a result of neighbour_start(), if `start` is farther.
FN Ray begun_by_neighbours(Ray ray, real start)
{
    // Until the first sample, last_t keeps the t at which begun_alone() begins. It is 0 only if there are no
    // neighbours.
    ray.last_t = pick(start > ray.t, larger(ray.t, R(1.0e-30)), 0);
    ray.t = larger(start, ray.t);
    return ray;
}

// Returns true if a ray began at neighbour_start() and its first sample there is already a hit. The ray may then have
// begun behind the surface, and must begin again, without neighbours, by begun_alone().
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

// A ray of a lattice whose pixels are the neighbours of others.
struct LatticeRay {
    Ray ray;
    real start;  // the t at which its cone and its neighbours let it begin
    real room;   // min over its samples of the estimate minus half the distance between the lattice's rays there
};

// Begins a lattice's ray at the end of its cone and at neighbour_start(); 0: there is none.
FN LatticeRay begin_lattice(Scene scene, Ray ray, real from_cone, real from_neighbours)
{
    LatticeRay a;
    ray.t = larger(from_cone, ray.t);
    a.ray = begun_by_neighbours(ray, from_neighbours);
    a.start = larger(from_cone, from_neighbours);
    a.room = scene.end;
    return a;
}

// Takes one step with a ray of the lattice (before, apart) of core/render/lattice.h.
FN LatticeRay advance_lattice(Scene scene, LatticeRay a, int before, int apart, mask on)
{
    Estimate here = probe(scene, a.ray, on);
    if (apart > 1) {
        scalar width = R(0.5) * apart * scene.spacing;
        a.room = pick(on, smaller(a.room, here.distance - width * a.ray.t), a.room);
    }
    a.ray = advanced(scene, a.ray, here, on);
    if (before > 0) a.ray = begun_alone(scene, a.ray, on && begun_too_late(scene, a.ray));
    return a;
}

// Returns the depth that a stopped ray passes on to its neighbours. A miss is clear if no ray of the pixels around it
// can hit, either by its start or because all samples had room.
FN real depth_passed_on(Scene scene, LatticeRay a)
{
    mask sampled = a.room < scene.end;
    mask roomy = sampled && a.room > 0 && a.ray.t > a.ray.end;
    real miss = pick(a.start > scene.end || roomy, clear_miss(), unclear_miss());
    return pick(has_hit(scene, a.ray), a.ray.last_t, miss);
}
