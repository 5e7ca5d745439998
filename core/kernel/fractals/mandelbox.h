// Kernel text, part 5: the Mandelbox (Lowe, "What is a Mandelbox?", 2010), with the running derivative of Buddhi and
// Rrrola (Fractal Forums, 2010): z -> s * sphere_fold(box_fold(z)) + p, k -> k |s| f + 1.
// An iteration ends a ray's loop by the square of the FOLDED point, before the sphere fold.

FN scalar box_scale(Scene scene) { return scene.fractal[0]; }          // s
FN scalar box_growth(Scene scene) { return scene.fractal[1]; }         // |s|
FN scalar box_inner_radius2(Scene scene) { return scene.fractal[2]; }  // rMin^2
FN scalar box_fixed_radius2(Scene scene) { return scene.fractal[3]; }  // rFixed^2
FN scalar box_inner_factor(Scene scene) { return scene.fractal[4]; }   // rFixed^2 / rMin^2
FN scalar box_escape2(Scene scene) { return scene.fractal[5]; }        // escape radius^2
FN scalar box_offset(Scene scene) { return scene.fractal[6]; }         // |s - 1|
FN scalar box_remainder(Scene scene) { return scene.fractal[7]; }      // |s|^(1 - n)

// c > 1: 2 - c; c < -1: -2 - c; else c.
FN real folded(real c)
{
    real edge = cut(c, -1, 1);
    return edge + edge - c;
}

FN vec3 box_fold(vec3 z) { return vec3(folded(z.x), folded(z.y), folded(z.z)); }

// The factor of the sphere fold at squared radius r2.
FN real sphere_fold(Scene scene, real r2)
{
    // Zero or not a number only where the shell is not picked.
    real shell = quick_quotient(box_fixed_radius2(scene), r2);
    return pick(r2 < box_inner_radius2(scene), box_inner_factor(scene), pick(r2 < box_fixed_radius2(scene), shell, 1));
}

// Where a ray can meet the surface: core/scene/hull.cpp proves the cube.
FN Span hull(Scene scene, vec3 origin, vec3 direction) { return cube_span(scene.hull, origin, direction); }

FN_CALLED Estimate estimate(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real k = 1;
    whole iterations = 0;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        vec3 f = box_fold(z);
        real r2 = inner(f, f);
        real factor = sphere_fold(scene, r2);
        z = pick3(on, along(p, times(factor, f), box_scale(scene)), z);
        k = pick(on, k * factor * box_growth(scene) + 1, k);
        iterations = iterations + count(on);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    Estimate result;
    result.distance = quotient(norm(z) - box_offset(scene), k) - box_remainder(scene);
    result.iterations = iterations;
    return result;
}

// d/dv of z and of k along one axis v of p.
struct BoxTangent {
    vec3 z;
    real k;
};

// One iteration of a tangent. The box fold turns its components (turn: -1 where folded, else 1); the sphere fold f has
// the slope df = -2 f/r2 (z . dz) in the shell and 0 elsewhere, given here as slope = -2 f/r2 or 0.
FN BoxTangent box_advance(Scene scene, BoxTangent v, vec3 axis, vec3 turn, vec3 f, real factor, real slope, real k)
{
    vec3 d = vec3(v.z.x * turn.x, v.z.y * turn.y, v.z.z * turn.z);
    real d_factor = slope * inner(f, d);
    BoxTangent next;
    next.z = along(axis, along(times(factor, d), f, d_factor), box_scale(scene));
    next.k = (v.k * factor + k * d_factor) * box_growth(scene);
    return next;
}

FN BoxTangent box_tangent(vec3 axis)
{
    BoxTangent v;
    v.z = axis;
    v.k = 0;
    return v;
}

FN BoxTangent box_pick(mask on, BoxTangent a, BoxTangent b)
{
    BoxTangent v;
    v.z = pick3(on, a.z, b.z);
    v.k = pick(on, a.k, b.k);
    return v;
}

// The derivative of DE, times k > 0.
FN real box_slope(Scene scene, vec3 z, real length, real k, BoxTangent v)
{
    return quotient(quotient(inner(z, v.z), length), k) - quotient(length - box_offset(scene), k) * quotient(v.k, k);
}

// The gradient of DE up to a positive factor, by forward differentiation of estimate() along the three axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real k = 1;
    BoxTangent x = box_tangent(vec3(1, 0, 0));
    BoxTangent y = box_tangent(vec3(0, 1, 0));
    BoxTangent w = box_tangent(vec3(0, 0, 1));
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        vec3 f = box_fold(z);
        vec3 turn = vec3(pick(magnitude(z.x) > 1, R(-1.0), R(1.0)), pick(magnitude(z.y) > 1, R(-1.0), R(1.0)),
                         pick(magnitude(z.z) > 1, R(-1.0), R(1.0)));
        real r2 = inner(f, f);
        real factor = sphere_fold(scene, r2);
        mask shell = r2 >= box_inner_radius2(scene) && r2 < box_fixed_radius2(scene);
        real slope = pick(shell, -2 * quotient(factor, r2), R(0.0));
        x = box_pick(on, box_advance(scene, x, vec3(1, 0, 0), turn, f, factor, slope, k), x);
        y = box_pick(on, box_advance(scene, y, vec3(0, 1, 0), turn, f, factor, slope, k), y);
        w = box_pick(on, box_advance(scene, w, vec3(0, 0, 1), turn, f, factor, slope, k), w);
        z = pick3(on, along(p, times(factor, f), box_scale(scene)), z);
        k = pick(on, k * factor * box_growth(scene) + 1, k);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    real length = norm(z);
    return vec3(box_slope(scene, z, length, k, x), box_slope(scene, z, length, k, y),
                box_slope(scene, z, length, k, w));
}

// The share of light that haze takes on a way of length t: half at about the fractal's size.
FN real haze(real t) { return quotient(t, t + R(8.0)); }

// Where the folded orbit of p passes nearest to the plane x = 0, to the diagonal plane x = y and to the middle, for
// colours. A few iterations, so that colours are smooth at the scale of a picture.
FN_CALLED vec3 orbit_trap(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    vec3 trap = vec3(1, 1, 1);
    int i = 0;
    while (i < scene.max_iterations && i < 8 && any(on)) {
        vec3 f = box_fold(z);
        real r2 = inner(f, f);
        vec3 near = vec3(smaller(trap.x, magnitude(f.x)), smaller(trap.y, magnitude(f.x - f.y)), smaller(trap.z, r2));
        trap = pick3(on, near, trap);
        z = pick3(on, along(p, times(sphere_fold(scene, r2), f), box_scale(scene)), z);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    return trap;
}
