// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 5, for tests: Sierpinski's tetrahedron as a kaleidoscopic iterated function system (Knighty,
// Fractal Forums, 2010), z -> s fold(z) - (s - 1) (1, 1, 1). Folds do not increase distances, and the rest of the map
// multiplies them by s, so the estimate is a lower bound.

FN scalar sierpinski_scale(Scene scene) { return scene.fractal[0]; }
FN scalar sierpinski_offset(Scene scene) { return scene.fractal[1]; }   // s - 1
FN scalar sierpinski_escape2(Scene scene) { return scene.fractal[2]; }  // escape radius^2
FN scalar sierpinski_radius(Scene scene) { return scene.fractal[3]; }   // radius of the sphere through the corners

// Return v, which is mirrored in the lanes of `on`. The mirrors are the planes x + y = 0, x + z = 0 and y + z = 0.
FN vec3 mirrored_xy(mask on, vec3 v) { return pick3(on, vec3(-v.y, -v.x, v.z), v); }
FN vec3 mirrored_xz(mask on, vec3 v) { return pick3(on, vec3(-v.z, v.y, -v.x), v); }
FN vec3 mirrored_yz(mask on, vec3 v) { return pick3(on, vec3(v.x, -v.z, -v.y), v); }

FN vec3 sierpinski_fold(vec3 z)
{
    z = mirrored_xy(z.x + z.y < 0, z);
    z = mirrored_xz(z.x + z.z < 0, z);
    return mirrored_yz(z.y + z.z < 0, z);
}

FN vec3 sierpinski_next(Scene scene, vec3 f)
{
    scalar s = sierpinski_scale(scene);
    scalar c = sierpinski_offset(scene);
    return vec3(s * f.x - c, s * f.y - c, s * f.z - c);
}

// Returns |z|^2, but at least 1e-30.
FN real sierpinski_r2(vec3 z) { return larger(dot3(z, z), R(1.0e-30)); }

// Returns the part of a ray that can meet the surface, which is the part inside a sphere. hull() in the descriptor
// (sierpinski.cpp) computes the sphere's radius, with a proof.
FN Span hull(scalar size, vec3 origin, vec3 direction) { return sphere_span(size, origin, direction); }

FN_SAMPLED Estimate estimate(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real k = 1;
    counter iterations = 0;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        z = pick3(on, sierpinski_next(scene, sierpinski_fold(z)), z);
        k = pick(on, smaller(k * sierpinski_scale(scene), BY_PRECISION(1.0e300, 1.0e30)), k);
        iterations = tally(iterations, on);
        on = on && sierpinski_r2(z) < sierpinski_escape2(scene);
        i = i + 1;
    }
    Estimate result;
    result.distance = quotient(root(sierpinski_r2(z)) - sierpinski_radius(scene), k);
    result.iterations = iterations;
    return result;
}

// Returns the gradient of the estimate, multiplied by a positive factor. Differentiates forward along the three axes.
// Only the mirrors change the directions of these axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    vec3 x = vec3(1, 0, 0);
    vec3 y = vec3(0, 1, 0);
    vec3 w = vec3(0, 0, 1);
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        vec3 f = z;
        mask below = on && f.x + f.y < 0;
        f = mirrored_xy(below, f);
        x = mirrored_xy(below, x);
        y = mirrored_xy(below, y);
        w = mirrored_xy(below, w);
        below = on && f.x + f.z < 0;
        f = mirrored_xz(below, f);
        x = mirrored_xz(below, x);
        y = mirrored_xz(below, y);
        w = mirrored_xz(below, w);
        below = on && f.y + f.z < 0;
        f = mirrored_yz(below, f);
        x = mirrored_yz(below, x);
        y = mirrored_yz(below, y);
        w = mirrored_yz(below, w);
        z = pick3(on, sierpinski_next(scene, f), z);
        on = on && sierpinski_r2(z) < sierpinski_escape2(scene);
        i = i + 1;
    }
    return vec3(dot3(z, x), dot3(z, y), dot3(z, w));
}

// Returns the fraction of light that haze absorbs over a distance t: a half at 3, about the fractal's size.
FN real haze(real t) { return quotient(t, t + R(3.0)); }

// Returns the orbit's smallest distances from the planes x = 1 and y = z, and its smallest |z|^2, for colours.
FN_CALLED vec3 orbit_trap(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    vec3 trap = vec3(1, 1, 1);
    int i = 0;
    while (i < scene.max_iterations && i < 8 && any(on)) {
        z = pick3(on, sierpinski_next(scene, sierpinski_fold(z)), z);
        real r2 = sierpinski_r2(z);
        vec3 near =
            vec3(smaller(trap.x, magnitude(z.x - 1)), smaller(trap.y, magnitude(z.y - z.z)), smaller(trap.z, r2));
        trap = pick3(on, near, trap);
        on = on && r2 < sierpinski_escape2(scene);
        i = i + 1;
    }
    return trap;
}
