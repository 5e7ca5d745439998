// Kernel text, part 5: the Mandelbox (Lowe, "What is a Mandelbox?", 2010), with the running derivative of Buddhi and
// Rrrola (Fractal Forums, 2010): z -> s * sphere_fold(box_fold(z)) + p, k -> k |s| f + 1.
// An iteration ends a ray's loop by the square of the FOLDED point, before the sphere fold.

FN scalar box_scale(Scene scene) { return scene.fractal[0]; }          // s
FN scalar box_sign(Scene scene) { return scene.fractal[1]; }           // of s: -1 or 1
FN scalar box_inner_radius2(Scene scene) { return scene.fractal[2]; }  // rMin^2
FN scalar box_outer_radius2(Scene scene) { return scene.fractal[3]; }  // the larger of rMin^2 and rFixed^2
FN scalar box_shell_scale(Scene scene) { return scene.fractal[4]; }    // s rFixed^2
FN scalar box_escape2(Scene scene) { return scene.fractal[5]; }        // escape radius^2
FN scalar box_offset(Scene scene) { return scene.fractal[6]; }         // |s - 1|
FN scalar box_remainder(Scene scene) { return scene.fractal[7]; }      // |s|^(1 - n)

// c > 1: 2 - c; c < -1: -2 - c; else c.
FN real folded(real c) { return 2 * clipped(c) - c; }

FN vec3 box_fold(vec3 z) { return vec3(folded(z.x), folded(z.y), folded(z.z)); }

// s times the factor of the sphere fold at squared radius r2.
FN real sphere_fold(Scene scene, real r2)
{
    real shell = quick_quotient(box_shell_scale(scene), larger(r2, box_inner_radius2(scene)));
    return pick(r2 < box_outer_radius2(scene), shell, box_scale(scene));
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
        vec3 f = pick3(on, box_fold(z), z);
        real r2 = inner(f, f);
        real factor = sphere_fold(scene, r2);
        z = pick3(on, along(p, f, factor), f);
        k = pick(on, k * magnitude(factor) + 1, k);
        iterations = tally(iterations, on);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    Estimate result;
    result.distance = rough_quotient(quick_norm(z) - box_offset(scene), smaller(k, BY_PRECISION(1.0e300, 1.0e30))) -
                      box_remainder(scene);
    result.iterations = iterations;
    return result;
}

// d/dv of z and of k along one axis v of p.
struct BoxTangent {
    vec3 z;
    real k;
};

// What an iteration is to every tangent.
struct BoxStep {
    mask on;
    mask folded_x;  // components that the box fold turns
    mask folded_y;
    mask folded_z;
    vec3 f;       // the folded point
    real factor;  // c of the sphere fold, s included
    real growth;  // |c|
    real slope;   // -2 c/r2 in the shell, else 0
    real k;       // with the sign of s
};

// One iteration of a tangent: c has the slope -2 c/r2 (f . d) in the shell and 0 elsewhere. A lane that is off keeps
// its values: masked instructions hold them without further ones.
FN BoxTangent box_advance(BoxTangent v, vec3 axis, BoxStep turn)
{
    vec3 d = vec3(pick(turn.folded_x, -v.z.x, v.z.x), pick(turn.folded_y, -v.z.y, v.z.y),
                  pick(turn.folded_z, -v.z.z, v.z.z));
    real d_factor = turn.slope * inner(turn.f, d);
    BoxTangent next;
    next.z = pick3(turn.on, along(along(axis, turn.f, d_factor), d, turn.factor), d);
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

// The derivative of DE, times k > 0.
FN real box_slope(Scene scene, vec3 z, real length, real k, BoxTangent v)
{
    return quick_quotient(quick_quotient(inner(z, v.z), length) - quick_quotient(length - box_offset(scene), k) * v.k,
                          k);
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
        BoxStep turn;
        turn.on = on;
        turn.folded_x = on && magnitude(z.x) > 1;
        turn.folded_y = on && magnitude(z.y) > 1;
        turn.folded_z = on && magnitude(z.z) > 1;
        turn.f = pick3(on, box_fold(z), z);
        real r2 = inner(turn.f, turn.f);
        turn.factor = sphere_fold(scene, r2);
        turn.growth = magnitude(turn.factor);
        mask shell = r2 >= box_inner_radius2(scene) && r2 < box_outer_radius2(scene);
        // Not r2 itself: its reciprocal is there already.
        turn.slope = pick(shell, -2 * quick_quotient(turn.factor, larger(r2, box_inner_radius2(scene))), 0);
        turn.k = k * box_sign(scene);
        x = box_advance(x, vec3(1, 0, 0), turn);
        y = box_advance(y, vec3(0, 1, 0), turn);
        w = box_advance(w, vec3(0, 0, 1), turn);
        z = pick3(on, along(p, turn.f, turn.factor), turn.f);
        k = pick(on, k * turn.growth + 1, k);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    real length = quick_norm(z);
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
        z = pick3(on, along(p, f, sphere_fold(scene, r2)), z);
        on = on && r2 < box_escape2(scene);
        i = i + 1;
    }
    return trap;
}
