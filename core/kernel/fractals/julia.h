// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 5: a quaternion Julia set, z -> z^2 + c (Norton, "Generation and display of geometric fractals in
// 3-D", SIGGRAPH 1982), in its cross-section with the space k = 0. Its distance estimate is DE = 0.5 ln(r) r / dr with
// dr -> 2 r dr (Hart, Sandin and Kauffman, "Ray tracing deterministic 3-D fractals", SIGGRAPH 1989).

FN scalar julia_escape2(Scene scene) { return scene.fractal[4]; }  // squared escape radius

// The quaternion with real part `a` and imaginary parts i, j and k.
struct Quaternion {
    real a;
    real i;
    real j;
    real k;
};

FN Quaternion quaternion(real a, real i, real j, real k)
{
    Quaternion q;
    q.a = a;
    q.i = i;
    q.j = j;
    q.k = k;
    return q;
}

FN Quaternion quaternion_pick(mask on, Quaternion p, Quaternion q)
{
    return quaternion(pick(on, p.a, q.a), pick(on, p.i, q.i), pick(on, p.j, q.j), pick(on, p.k, q.k));
}

FN real quaternion_inner(Quaternion p, Quaternion q) { return p.a * q.a + p.i * q.i + p.j * q.j + p.k * q.k; }

FN real vector_inner(Quaternion p, Quaternion q) { return p.i * q.i + p.j * q.j + p.k * q.k; }

// Returns |z|^2, but at least 1e-30, so that no term that matters is flushed to zero. A point so close to 0 is
// certainly inside the set.
FN real julia_r2(Quaternion z) { return larger(quaternion_inner(z, z), R(1.0e-30)); }

FN Quaternion julia_next(Scene scene, Quaternion z)
{
    real twice = z.a + z.a;
    return quaternion(z.a * z.a - vector_inner(z, z) + scene.fractal[0], twice * z.i + scene.fractal[1],
                      twice * z.j + scene.fractal[2], twice * z.k + scene.fractal[3]);
}

FN_SAMPLED Estimate estimate(Scene scene, vec3 p, mask on)
{
    Quaternion z = quaternion(p.x, p.y, p.z, 0);
    real dr = 1;
    real r2 = julia_r2(z);
    counter iterations = 0;
    on = on && r2 <= julia_escape2(scene);
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        // Inside the set, dr tends to zero. The lower bound keeps the quotient after the loop finite.
        dr = pick(on, larger(2 * root(r2) * dr, R(1.0e-20)), dr);
        z = quaternion_pick(on, julia_next(scene, z), z);
        r2 = pick(on, julia_r2(z), r2);
        iterations = tally(iterations, on);
        on = on && r2 <= julia_escape2(scene);
        i = i + 1;
    }
    real r = root(r2);
    Estimate result;
    result.distance = quotient(R(0.5) * natural_log(r) * r, dr);
    result.iterations = iterations;
    return result;
}

// Derivatives of z and of ln dr along one coordinate axis of the point p.
struct JuliaTangent {
    Quaternion z;
    real ln_dr;
};

FN JuliaTangent julia_tangent(real a, real i, real j)
{
    JuliaTangent v;
    v.z = quaternion(a, i, j, 0);
    v.ln_dr = 0;
    return v;
}

FN JuliaTangent julia_advance(mask on, JuliaTangent v, Quaternion z, real r2)
{
    JuliaTangent next;
    next.ln_dr = pick(on, v.ln_dr + quotient(quaternion_inner(z, v.z), r2), v.ln_dr);
    Quaternion d = quaternion(2 * (z.a * v.z.a - vector_inner(z, v.z)), 2 * (z.a * v.z.i + z.i * v.z.a),
                              2 * (z.a * v.z.j + z.j * v.z.a), 2 * (z.a * v.z.k + z.k * v.z.a));
    next.z = quaternion_pick(on, d, v.z);
    return next;
}

// Returns the derivative of DE along v, multiplied by dr, which is positive.
FN real julia_slope(Quaternion z, real r, real ln_r, JuliaTangent v)
{
    return (ln_r + 1) * quotient(quaternion_inner(z, v.z), r) - ln_r * r * v.ln_dr;
}

// Returns the gradient of DE up to a positive factor. Differentiates estimate() in forward mode along the three axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    Quaternion z = quaternion(p.x, p.y, p.z, 0);
    real r2 = julia_r2(z);
    JuliaTangent x = julia_tangent(1, 0, 0);
    JuliaTangent y = julia_tangent(0, 1, 0);
    JuliaTangent w = julia_tangent(0, 0, 1);
    on = on && r2 <= julia_escape2(scene);
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        x = julia_advance(on, x, z, r2);
        y = julia_advance(on, y, z, r2);
        w = julia_advance(on, w, z, r2);
        z = quaternion_pick(on, julia_next(scene, z), z);
        r2 = pick(on, julia_r2(z), r2);
        on = on && r2 <= julia_escape2(scene);
        i = i + 1;
    }
    real r = root(r2);
    real ln_r = natural_log(r);
    return vec3(julia_slope(z, r, ln_r, x), julia_slope(z, r, ln_r, y), julia_slope(z, r, ln_r, w));
}

// Returns, for colours, the min distances of the orbit of p from the spaces a = 0 and j = 0, and the min of |z|^2. Uses
// few iterations, so that colours are smooth at the scale of a picture.
FN_CALLED vec3 orbit_trap(Scene scene, vec3 p, mask on)
{
    Quaternion z = quaternion(p.x, p.y, p.z, 0);
    real r2 = julia_r2(z);
    vec3 trap = vec3(1, 1, 1);
    on = on && r2 <= julia_escape2(scene);
    int i = 0;
    while (i < scene.max_iterations && i < 10 && any(on)) {
        z = quaternion_pick(on, julia_next(scene, z), z);
        r2 = pick(on, julia_r2(z), r2);
        on = on && r2 <= julia_escape2(scene);
        vec3 near = vec3(smaller(trap.x, magnitude(z.a)), smaller(trap.y, magnitude(z.j)), smaller(trap.z, r2));
        trap = pick3(on, near, trap);
        i = i + 1;
    }
    return trap;
}
