// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 5: the Mandelbox (Lowe, "What is a Mandelbox?", 2010), z -> s * sphere_fold(box_fold(z)) + p,
// with the running derivative of Buddhi and Rrrola (Fractal Forums, 2010), k -> k |s| f + 1, where f is the factor of
// the sphere fold. The escape test uses the squared radius after the box fold and before the sphere fold. Lengths are
// in units of sqrt(|s|) rFixed; in these units |s| f is 1 / r^2 in the shell between rMin and rFixed.

#define MM_SIZE R(8.0)
#define MM_HULL_SPAN cube_span

FN scalar box_scale(Scene scene) { return scene.fractal[0]; }          // |s|
FN scalar box_sign(Scene scene) { return scene.fractal[1]; }           // sign of s: -1 or 1
FN scalar box_inner_radius2(Scene scene) { return scene.fractal[2]; }  // rMin^2
FN scalar box_outer_radius2(Scene scene) { return scene.fractal[3]; }  // max of rMin^2 and rFixed^2
FN scalar box_one(Scene scene) { return scene.fractal[4]; }            // the length 1, in these units
FN scalar box_unit(Scene scene) { return scene.fractal[5]; }           // the unit, as a length
FN scalar box_escape2(Scene scene) { return scene.fractal[6]; }        // squared escape radius
FN scalar box_tail2(Scene scene) { return scene.fractal[7]; }          // squared radius at which a tail begins
FN scalar box_offset(Scene scene) { return scene.fractal[8]; }         // |s - 1|
FN scalar box_remainder(Scene scene) { return scene.fractal[9]; }      // |s|^(1 - n), as a length, not in units
FN int box_tail_end(Scene scene) { return scene.fractal_whole; }       // no tail begins from this iteration on; 0: none

// Returns 2 - c for c > 1, -2 - c for c < -1, otherwise c. `one` is the length 1 in the units of c.
FN real folded(real c, scalar one) { return 2 * clipped(c, one) - c; }

FN vec3 box_fold(Scene scene, vec3 z)
{
    return vec3(folded(z.x, box_one(scene)), folded(z.y, box_one(scene)), folded(z.z, box_one(scene)));
}

// Returns |s| times the factor of the sphere fold, for a squared radius r2 inside the fold's outer sphere.
FN real box_shell(Scene scene, real r2) { return quick_quotient(1, larger(r2, box_inner_radius2(scene))); }

// Returns |s| times the factor of the sphere fold, for any squared radius r2.
FN real box_growth(Scene scene, real r2)
{
    return pick(r2 < box_outer_radius2(scene), box_shell(scene, r2), box_scale(scene));
}

struct BoxOrbit {
    vec3 z;
    real k;
    mask late;  // lanes that reached the iteration box_tail_end(), and so have no tail
    counter iterations;
};

// Iterates the orbit of p until it escapes or its tail begins. `usual` is a compile-time constant. If it is 1, the
// factor of an iteration is computed as the max of two terms, which requires s > 0 and rMin <= rFixed. 0 works for all
// scenes.
FN BoxOrbit box_orbit(Scene scene, vec3 p, mask on, int usual)
{
    BoxOrbit a;
    a.z = p;
    a.k = 1;
    mask off = !on;
    a.late = on && off;
    a.iterations = 0;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        scalar last2 = box_escape2(scene);
        if (i < box_tail_end(scene)) last2 = box_tail2(scene);
        if (i == box_tail_end(scene)) a.late = on;
        vec3 f = pick3(on, box_fold(scene, a.z), a.z);
        real r2 = dot3(f, f);
        real growth = box_growth(scene, r2);
        real factor = growth * box_sign(scene);
        if (usual != 0) {
            growth = larger(box_shell(scene, r2), box_scale(scene));
            factor = growth;
        }
        a.z = pick3(on, along(p, f, factor), f);
        a.k = pick(on, a.k * growth + 1, a.k);
        a.iterations = tally(a.iterations, on);
        on = on && r2 < last2;
        i = i + 1;
    }
    return a;
}

// Returns the next point of an orbit far outside, where the sphere fold does not change the folded point f.
FN vec3 box_outside(Scene scene, vec3 p, vec3 f) { return along(p, f, box_scale(scene) * box_sign(scene)); }

FN real box_outside_k(Scene scene, real k) { return k * box_scale(scene) + 1; }

// Computes the tail of an orbit: its last three or four iterations. The descriptor chooses the radius at which a tail
// begins so that, with rare exceptions, none of these iterations needs a sphere fold, and only one an escape test.
FN BoxOrbit box_tail(Scene scene, vec3 p, mask on, BoxOrbit a)
{
    BoxOrbit b;
    vec3 f = box_fold(scene, a.z);
    f = box_fold(scene, box_outside(scene, p, f));
    f = box_fold(scene, box_outside(scene, p, f));
    mask more = dot3(f, f) < box_escape2(scene);
    b.z = box_outside(scene, p, f);
    b.z = pick3(more, box_outside(scene, p, box_fold(scene, b.z)), b.z);
    b.k = box_outside_k(scene, box_outside_k(scene, box_outside_k(scene, a.k)));
    b.k = pick(more, box_outside_k(scene, b.k), b.k);
    b.late = a.late;
    if (any(a.late)) {
        b.z = pick3(a.late, a.z, b.z);
        b.k = pick(a.late, a.k, b.k);
        on = on && !a.late;
    }
    b.iterations = tally(tally(tally(tally(a.iterations, on), on), on), on && more);
    return b;
}

FN_SAMPLED Estimate estimate(Scene scene, vec3 p, mask on)
{
    vec3 q = times(box_one(scene), p);
    BoxOrbit a;
    if (box_sign(scene) > 0 && box_inner_radius2(scene) * box_scale(scene) <= 1) {
        a = box_orbit(scene, q, on, 1);
    } else {
        a = box_orbit(scene, q, on, 0);
    }
    if (box_tail_end(scene) > 0) a = box_tail(scene, q, on, a);
    real far = quick_norm(a.z) - box_offset(scene);
    Estimate result;
    result.distance =
        rough_quotient(far, smaller(a.k, BY_PRECISION(1.0e300, 1.0e30))) * box_unit(scene) - box_remainder(scene);
    result.iterations = a.iterations;
    return result;
}

// Derivatives of z and of k along one coordinate axis of the point p.
struct BoxTangent {
    vec3 z;
    real k;
};

// Terms of one iteration that are the same for all three tangents. The box fold reverses the derivative of a component
// that it folds; "with signs" below means: the folded components are negated.
struct BoxStep {
    mask on;
    vec3 f;       // the point after the box fold
    vec3 across;  // f, with signs
    vec3 turned;  // (c, c, c), where c is s times the factor of the sphere fold; with signs
    real growth;  // |c|
    real slope;   // in the shell, where |c| = 1/r2: -2 c/r2; otherwise 0
    real k;       // k before the iteration, times the sign of s
};

// Returns -a if the box fold changes the component c, otherwise a.
FN real box_turned(Scene scene, real c, real a) { return pick(magnitude(c) > box_one(scene), -a, a); }

FN vec3 box_turned3(Scene scene, vec3 z, vec3 a)
{
    return vec3(box_turned(scene, z.x, a.x), box_turned(scene, z.y, a.y), box_turned(scene, z.z, a.z));
}

// Computes one iteration of a tangent. For a derivative d of the folded point f, the derivative of c is turn.slope
// times f . d. Inactive lanes keep their values.
FN BoxTangent box_advance(BoxTangent v, vec3 axis, BoxStep turn)
{
    real d_factor = turn.slope * dot3(turn.across, v.z);
    vec3 outward = along(axis, turn.f, d_factor);
    BoxTangent next;
    next.z = pick3(
        turn.on,
        vec3(v.z.x * turn.turned.x + outward.x, v.z.y * turn.turned.y + outward.y, v.z.z * turn.turned.z + outward.z),
        v.z);
    next.k = pick(turn.on, v.k * turn.growth + turn.k * d_factor, v.k);
    return next;
}

FN BoxTangent box_tangent(vec3 axis)
{
    BoxTangent v;
    v.z = axis;
    v.k = 0;
    return v;
}

// State of a tail. Far outside, an iteration maps each component separately.
struct BoxFar {
    vec3 z;
    real r2;      // squared radius after the last box fold
    vec3 slope;   // derivative of each component with respect to its value at the beginning of the tail
    vec3 direct;  // derivative of each component with respect to that component of p, through the tail's additions of p
    real k;
    real growth;  // derivative of k with respect to its value at the beginning of the tail
};

// Computes one more iteration of the tail in the active lanes.
FN BoxFar box_farther(Scene scene, vec3 q, BoxFar a, mask on)
{
    real factor = box_scale(scene) * box_sign(scene);
    vec3 turned = box_turned3(scene, a.z, vec3(factor, factor, factor));
    vec3 f = box_fold(scene, a.z);
    BoxFar b;
    b.r2 = dot3(f, f);
    b.z = pick3(on, box_outside(scene, q, f), a.z);
    b.slope = pick3(on, vec3(a.slope.x * turned.x, a.slope.y * turned.y, a.slope.z * turned.z), a.slope);
    b.direct =
        pick3(on, vec3(a.direct.x * turned.x + 1, a.direct.y * turned.y + 1, a.direct.z * turned.z + 1), a.direct);
    b.k = pick(on, box_outside_k(scene, a.k), a.k);
    b.growth = pick(on, a.growth * box_scale(scene), a.growth);
    return b;
}

// Returns the derivative of DE along the tangent v, multiplied by k, which is positive. `direct`: the component of
// end.direct along the tangent's axis, times the same component of end.z.
FN real box_slope(Scene scene, BoxFar end, real direct, real length, BoxTangent v)
{
    vec3 towards = vec3(end.z.x * end.slope.x, end.z.y * end.slope.y, end.z.z * end.slope.z);
    real outward = quick_quotient(dot3(towards, v.z) + direct, length);
    return quick_quotient(outward - quick_quotient(length - box_offset(scene), end.k) * (v.k * end.growth), end.k);
}

// Returns the gradient of DE up to a positive factor. Differentiates estimate() in forward mode along the three axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    vec3 q = times(box_one(scene), p);
    vec3 z = q;
    real k = 1;
    BoxTangent x = box_tangent(vec3(1, 0, 0));
    BoxTangent y = box_tangent(vec3(0, 1, 0));
    BoxTangent w = box_tangent(vec3(0, 0, 1));
    mask tailed = on;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        scalar last2 = box_escape2(scene);
        if (i < box_tail_end(scene)) last2 = box_tail2(scene);
        if (i == box_tail_end(scene)) tailed = tailed && !on;
        BoxStep turn;
        turn.on = on;
        turn.f = pick3(on, box_fold(scene, z), z);
        real r2 = dot3(turn.f, turn.f);
        turn.growth = box_growth(scene, r2);
        real factor = turn.growth * box_sign(scene);
        turn.across = box_turned3(scene, z, turn.f);
        turn.turned = box_turned3(scene, z, vec3(factor, factor, factor));
        mask shell = r2 >= box_inner_radius2(scene) && r2 < box_outer_radius2(scene);
        turn.slope = pick(shell, -2 * turn.growth * factor, 0);
        turn.k = k * box_sign(scene);
        x = box_advance(x, vec3(1, 0, 0), turn);
        y = box_advance(y, vec3(0, 1, 0), turn);
        w = box_advance(w, vec3(0, 0, 1), turn);
        z = pick3(on, along(q, turn.f, factor), turn.f);
        k = pick(on, k * turn.growth + 1, k);
        on = on && r2 < last2;
        i = i + 1;
    }
    BoxFar end;
    end.z = z;
    end.r2 = 0;
    end.slope = vec3(1, 1, 1);
    end.direct = vec3(0, 0, 0);
    end.k = k;
    end.growth = 1;
    if (box_tail_end(scene) > 0) {
        // These are the same iterations as in box_tail().
        end = box_farther(scene, q, end, tailed);
        end = box_farther(scene, q, end, tailed);
        end = box_farther(scene, q, end, tailed);
        end = box_farther(scene, q, end, tailed && end.r2 < box_escape2(scene));
    }
    real length = quick_norm(end.z);
    return vec3(box_slope(scene, end, end.z.x * end.direct.x, length, x),
                box_slope(scene, end, end.z.y * end.direct.y, length, y),
                box_slope(scene, end, end.z.z * end.direct.z, length, w));
}

// Returns, for colours, the min distances of the folded orbit of p from the planes x = 0 and x = y (the latter up to a
// factor), and the min of r^2. Uses few iterations, so that colours are smooth at the scale of a picture.
FN_CALLED vec3 orbit_trap(Scene scene, vec3 p, mask on)
{
    vec3 q = times(box_one(scene), p);
    scalar unit = box_unit(scene);
    vec3 z = q;
    vec3 trap = vec3(1, 1, 1);
    int i = 0;
    while (i < scene.max_iterations && i < 8 && any(on)) {
        vec3 f = box_fold(scene, z);
        real r2 = dot3(f, f);
        vec3 near = vec3(smaller(trap.x, magnitude(f.x) * unit), smaller(trap.y, magnitude(f.x - f.y) * unit),
                         smaller(trap.z, r2 * (unit * unit)));
        trap = pick3(on, near, trap);
        z = pick3(on, along(q, f, box_growth(scene, r2) * box_sign(scene)), z);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    return trap;
}
