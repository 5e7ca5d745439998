// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 5, for tests: Sierpinski's tetrahedron as a kaleidoscopic iterated function system (Knighty,
// Fractal Forums, 2010), z -> s fold(z) - (s - 1) (1, 1, 1). Folds do not increase distances, and the rest of the map
// multiplies them by s, so the estimate is a lower bound. This fractal takes every default that a kernel source can
// take.
#define MM_NO_GRADIENT

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
