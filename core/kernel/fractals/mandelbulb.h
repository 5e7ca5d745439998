// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 5: the Mandelbulb (White and Nylander, Fractal Forums, 2009), z -> z^P + p, where z^P
// multiplies the spherical angles by P. The estimate is DE = 0.5 ln(r) r / dr with the running derivative dr (Quilez,
// "Mandelbulb", 2009).

// Number of registers of openmp's wide packs (vectors of pixels) with AVX-512. Three hide the latency of an iteration,
// and cause fewer spills than four (docs/notes/experiments.md).
#define MM_WIDE_REGISTERS_AVX3 3
#define MM_SIZE R(1.6)

FN scalar bulb_bailout(Scene scene) { return scene.fractal[0]; }
FN scalar bulb_power(Scene scene) { return scene.fractal[1]; }        // P
FN scalar bulb_envelope(Scene scene) { return scene.fractal[2]; }     // c of conservative_growth(); 0: none
FN int bulb_whole_power(Scene scene) { return scene.fractal_whole; }  // P; 0 if P is not an integer

// Returns the factor by which dr grows in an iteration, for the conservative estimate. At the polar angle theta, z ->
// z^P stretches lengths by P r^(P-1) along the radius and the meridian, and by |sin(P theta) / sin(theta)| times as
// much along the parallel. The original running derivative uses P r^(P-1) only, which near the poles is up to P times
// too small. The quotient of sines has lobes, and an estimate with lobes changes faster than the distance. Its
// envelope min(P, 1 / sin(theta)) has no lobes, and a fraction c of the envelope suffices
// (docs/notes/experiments.md). growth: P r^(P-1). per_sine: 1 / sin(theta).
FN real conservative_growth(Scene scene, real growth, real per_sine)
{
    return growth * larger(bulb_envelope(scene) * smaller(per_sine, bulb_power(scene)), 1);
}

// z^P = r^P (sin(P theta) cos(P phi), sin(P theta) sin(P phi), cos(P theta)), where theta is the polar angle from the z
// axis and phi the azimuth.
struct BulbPower {
    real rho;         // sqrt(x^2 + y^2)
    real per_rho;     // 1 / rho
    real r_less;      // r^(P-1)
    Complex polar;    // r^P (cos(P theta) + i sin(P theta))
    Complex azimuth;  // cos(P phi) + i sin(P phi)
};

// Returns the lower limit of the squared distance from the z axis. It keeps every term that matters a normal number, so
// that devices that flush subnormal numbers to zero render the same picture. For points this close to the axis the
// azimuth does not matter.
FN real axis_radius2() { return BY_PRECISION(1.0e-290, 1.0e-30); }

FN BulbPower bulb_raised(Scene scene, vec3 z, real r, real r2)
{
    real rho2 = larger(z.x * z.x + z.y * z.y, axis_radius2());
    BulbPower power;
    if (bulb_whole_power(scene) == 8) {
        power.per_rho = scaled_inverse_root(rho2, 1);
        power.rho = rho2 * power.per_rho;
        real r4 = r2 * r2;
        power.r_less = r4 * r2 * r;
        power.polar = squared_within(squared_within(squared_within(complex_number(z.z, power.rho), r2), r4), r4 * r4);
        Complex direction = complex_number(z.x * power.per_rho, z.y * power.per_rho);
        power.azimuth = squared_within(squared_within(squared_within(direction, 1), 1), 1);
    } else if (bulb_whole_power(scene) > 0) {
        // Without trigonometric functions: polar = (z + i rho)^P, azimuth = ((x + i y) / rho)^P.
        power.per_rho = scaled_inverse_root(rho2, 1);
        power.rho = quick_root(rho2);
        Complex direction = complex_number(z.x * power.per_rho, z.y * power.per_rho);
        power.polar = raised(complex_number(z.z, power.rho), bulb_whole_power(scene));
        power.azimuth = raised(direction, bulb_whole_power(scene));
        power.r_less = raised_real(r, bulb_whole_power(scene) - 1);
    } else {
        power.per_rho = scaled_inverse_root(rho2, 1);
        power.rho = quick_root(rho2);
        real ln_r = natural_log(r);
        real r_power = exponential(bulb_power(scene) * ln_r);
        Complex turned = cosine_and_sine(bulb_power(scene) * angle_of(power.rho, z.z));
        real azimuth = angle_of(z.y, z.x);
        power.polar = complex_number(r_power * turned.re, r_power * turned.im);
        power.azimuth = cosine_and_sine(bulb_power(scene) * azimuth);
        power.r_less = exponential((bulb_power(scene) - 1) * ln_r);
    }
    return power;
}

// Returns z^P + p.
FN vec3 bulb_next(BulbPower power, vec3 p)
{
    return vec3(power.polar.im * power.azimuth.re + p.x, power.polar.im * power.azimuth.im + p.y, power.polar.re + p.z);
}

// For the eighth power, lengths are in units of 2^(-1/7). In these units the next point is z^8 / 2 + p, and the factor
// 8 r^7 of the derivative becomes 4 r^7.
FN scalar eighth_one() { return R(1.1040895136738123); }  // the length 1 in these units: 2^(1/7)

struct BulbEighth {
    vec3 z;       // z^8 / 2 + p
    real growth;  // 4 r^7
};

// Computes an iteration for the power 8 by doubling both angles three times, with cos 2v = 2 cos^2 v - 1.
// Polar angle v: z^2 - rho^2 = r^2 cos 2v gives r^4 cos 4v and r^8 cos 8v; r^8 sin 8v is 8 z rho times r^2 cos 2v and
// r^4 cos 4v. Azimuth v: if a = 2 cos v, then 2 cos 2v = a^2 - 2, and 2 sin 2v is a times 2 sin v. rho2: x^2 + y^2.
FN BulbEighth bulb_eighth(Scene scene, vec3 z, real rho2, real r2, vec3 p)
{
    real away2 = larger(rho2, axis_radius2());
    real inverse = scaled_inverse_root(away2, 2);  // 2 / rho
    real r4 = r2 * r2;
    real r8 = r4 * r4;
    real polar = z.z * z.z - away2;
    real sine = z.z * (away2 * inverse) * polar;
    polar = (polar + polar) * polar - r4;
    sine = sine * polar;  // r^8 sin 8v / 4
    polar = (polar + polar) * polar - r8;
    real cosine = z.x * inverse;
    real across = z.y * inverse;
    across = across * cosine;
    cosine = cosine * cosine - 2;
    across = across * cosine;
    cosine = cosine * cosine - 2;
    across = across * cosine;
    cosine = cosine * cosine - 2;
    BulbEighth next;
    next.z = vec3(sine * cosine + p.x, sine * across + p.y, polar * R(0.5) + p.z);
    next.growth = over_root(4 * r8, 4 * (r4 * r2), r2);
    if (bulb_envelope(scene) > 0) {
        next.growth = conservative_growth(scene, next.growth, R(0.5) * rough_root(r2) * inverse);
    }
    return next;
}

FN real rho2_of(vec3 z) { return z.x * z.x + z.y * z.y; }

// Returns norm2(z), computed from rho2 = x^2 + y^2.
FN real r2_of(vec3 z, real rho2) { return larger(z.z * z.z + rho2, axis_radius2()); }

FN Estimate bulb_estimate(real r2, real dr, counter iterations)
{
    Estimate result;
    result.distance =
        rough_quotient(R(0.25) * rough_log(r2) * rough_root(r2), smaller(dr, BY_PRECISION(1.0e300, 1.0e30)));
    result.iterations = iterations;
    return result;
}

// The estimate for the power 8. It has a loop of its own, because terms that only other powers need would occupy
// registers.
FN_SAMPLED Estimate estimate_eighth(Scene scene, vec3 p, mask on)
{
    vec3 q = times(eighth_one(), p);
    vec3 z = q;
    real dr = 1;
    real rho2 = rho2_of(z);
    real r2 = r2_of(z, rho2);
    scalar bailout2 = bulb_bailout(scene) * bulb_bailout(scene) * (eighth_one() * eighth_one());
    counter iterations = 0;
    on = on && r2 <= bailout2;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        // Updates z in inactive lanes, too. This is harmless, because their z is not used any more.
        BulbEighth next = bulb_eighth(scene, z, rho2, r2, q);
        dr = pick(on, dr * next.growth + 1, dr);
        z = next.z;
        rho2 = rho2_of(z);
        iterations = tally(iterations, on);
        i = i + 1;
        // The original program does not update the radius after the last iteration.
        if (i < scene.max_iterations) r2 = pick(on, r2_of(z, rho2), r2);
        on = on && r2 <= bailout2;
    }
    return bulb_estimate(r2 * R(0.8203353560076380), dr, iterations);
}

FN_SAMPLED Estimate estimate_any(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real dr = 1;
    real r2 = norm2(z);
    scalar bailout2 = bulb_bailout(scene) * bulb_bailout(scene);
    counter iterations = 0;
    on = on && r2 <= bailout2;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        real r = quick_root(r2);
        BulbPower power = bulb_raised(scene, z, r, r2);
        real growth = power.r_less * bulb_power(scene);
        if (bulb_envelope(scene) > 0) growth = conservative_growth(scene, growth, r * power.per_rho);
        dr = pick(on, dr * growth + 1, dr);
        z = bulb_next(power, p);
        iterations = tally(iterations, on);
        i = i + 1;
        if (i < scene.max_iterations) r2 = pick(on, norm2(z), r2);
        on = on && r2 <= bailout2;
    }
    return bulb_estimate(r2, dr, iterations);
}

FN Estimate estimate(Scene scene, vec3 p, mask on)
{
    Estimate result;
    if (bulb_whole_power(scene) == 8) {
        result = estimate_eighth(scene, p, on);
    } else {
        result = estimate_any(scene, p, on);
    }
    return result;
}

#include "core/kernel/fractals/mandelbulb/gradient.h"

// Returns, for colours, the min of |x|, |z| and r^2 along the orbit of p. Uses few iterations, so that colours are
// smooth at the scale of a picture.
FN_CALLED vec3 orbit_trap(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real r = norm(z);
    vec3 trap = vec3(1, 1, 1);
    on = on && r <= bulb_bailout(scene);
    int i = 0;
    while (i < scene.max_iterations && i < 6 && any(on)) {
        BulbPower power = bulb_raised(scene, z, r, r * r);
        z = pick3(on, bulb_next(power, p), z);
        r = pick(on, norm(z), r);
        on = on && r <= bulb_bailout(scene);
        vec3 near = vec3(smaller(trap.x, magnitude(z.x)), smaller(trap.y, magnitude(z.z)), smaller(trap.z, r * r));
        trap = pick3(on, near, trap);
        i = i + 1;
    }
    return trap;
}
