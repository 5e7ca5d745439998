// Kernel text, part 5: the Mandelbulb (White and Nylander, Fractal Forums, 2009): z -> z^P + p, where z^P multiplies
// the spherical angles by P; dr is the running derivative of Quilez ("Mandelbulb", 2009), DE = 0.5 ln(r) r / dr.

FN scalar bulb_bailout(Scene scene) { return scene.fractal[0]; }
FN scalar bulb_power(Scene scene) { return scene.fractal[1]; }  // P

// z^P: r^P (sin P0 cos P1, sin P0 sin P1, cos P0) with the polar angle 0 from the z axis and the azimuth 1.
struct BulbPower {
    real rho;         // sqrt(x^2 + y^2)
    real per_rho;     // its reciprocal
    real r_less;      // r^(P-1)
    Complex polar;    // r^P (cos P0 + i sin P0)
    Complex azimuth;  // cos P1 + i sin P1
};

// A point nearer to the z axis than this counts as being that far from it: no term that matters can then be subnormal,
// so that devices that flush subnormal numbers to zero draw the same picture. Its azimuth does not matter.
FN real axis_radius2() { return BY_PRECISION(1.0e-290, 1.0e-30); }

FN BulbPower bulb_raised(Scene scene, vec3 z, real r, real r2)
{
    real rho2 = larger(z.x * z.x + z.y * z.y, axis_radius2());
    BulbPower power;
    if (scene.exponent == 8) {
        power.per_rho = scaled_inverse_root(rho2, 1);
        power.rho = rho2 * power.per_rho;
        real r4 = r2 * r2;
        power.r_less = r4 * r2 * r;
        power.polar = squared_within(squared_within(squared_within(complex_number(z.z, power.rho), r2), r4), r4 * r4);
        Complex direction = complex_number(z.x * power.per_rho, z.y * power.per_rho);
        power.azimuth = squared_within(squared_within(squared_within(direction, 1), 1), 1);
    } else if (scene.exponent > 0) {
        // Without trigonometry: ((z + i rho))^P and ((x + i y) / rho)^P.
        power.per_rho = scaled_inverse_root(rho2, 1);
        power.rho = quick_root(rho2);
        Complex direction = complex_number(z.x * power.per_rho, z.y * power.per_rho);
        power.polar = raised(complex_number(z.z, power.rho), scene.exponent);
        power.azimuth = raised(direction, scene.exponent);
        power.r_less = raised_real(r, scene.exponent - 1);
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

// z^P + p
FN vec3 bulb_next(BulbPower power, vec3 p)
{
    return vec3(power.polar.im * power.azimuth.re + p.x, power.polar.im * power.azimuth.im + p.y, power.polar.re + p.z);
}

// Where a ray can meet the surface: core/scene/hull.cpp proves the sphere.
FN Span hull(Scene scene, vec3 origin, vec3 direction) { return sphere_span(scene.hull, origin, direction); }

// z^8 + p, |z|^2 = r2, by double angles whose factors of 2 stand in the constants: with a = s cos v the chain a^2 -
// s^2/2, a^2 - s^4/8, a^2 - s^8/128 ends with s^8/128 cos 8v, the polar sine carries another s, and s^9 = 128.
FN vec3 bulb_eighth(vec3 z, real r2, vec3 p)
{
    real rho2 = larger(z.x * z.x + z.y * z.y, axis_radius2());
    real inverse = scaled_inverse_root(rho2, R(1.7144879657061456));  // s
    real r4 = r2 * r2;
    Complex polar = complex_number(z.z, rho2 * inverse);
    polar = squared_within(squared_within(squared_within(polar, r2), r4), r4 * r4);
    real cosine = z.x * inverse;
    real sine = z.y * inverse;
    sine = sine * cosine;
    cosine = cosine * cosine - R(1.4697344922755988);  // s^2/2
    sine = sine * cosine;
    cosine = cosine * cosine - R(1.0800597388923059);  // s^4/8
    sine = sine * cosine;
    cosine = cosine * cosine - R(0.583264519788058);  // s^8/128
    return vec3(polar.im * cosine + p.x, polar.im * sine + p.y, polar.re + p.z);
}

FN Estimate bulb_estimate(real r2, real dr, whole iterations)
{
    real r = rough_root(r2);
    Estimate result;
    result.distance = rough_quotient(R(0.5) * natural_log(r) * r, smaller(dr, BY_PRECISION(1.0e300, 1.0e30)));
    result.iterations = iterations;
    return result;
}

// For power 8, in a loop of its own: what other powers need would take its registers.
FN_CALLED Estimate estimate_eighth(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real dr = 1;
    real r2 = norm2(z);
    scalar bailout2 = bulb_bailout(scene) * bulb_bailout(scene);
    whole iterations = 0;
    on = on && r2 <= bailout2;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        dr = pick(on, dr * (8 * (r2 * r2 * r2 * rough_root(r2))) + 1, dr);
        // Where a lane is off, z does not matter any more.
        z = bulb_eighth(z, r2, p);
        iterations = tally(iterations, on);
        i = i + 1;
        // The radius after the last iteration is not taken: the original leaves with the one before.
        if (i < scene.max_iterations) r2 = pick(on, norm2(z), r2);
        on = on && r2 <= bailout2;
    }
    return bulb_estimate(r2, dr, iterations);
}

FN_CALLED Estimate estimate_any(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real dr = 1;
    real r2 = norm2(z);
    scalar bailout2 = bulb_bailout(scene) * bulb_bailout(scene);
    whole iterations = 0;
    on = on && r2 <= bailout2;
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        BulbPower power = bulb_raised(scene, z, quick_root(r2), r2);
        dr = pick(on, dr * (power.r_less * bulb_power(scene)) + 1, dr);
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
    if (scene.exponent == 8) {
        result = estimate_eighth(scene, p, on);
    } else {
        result = estimate_any(scene, p, on);
    }
    return result;
}

// d/dv of z, r and dr along one axis v of p.
struct BulbTangent {
    vec3 z;
    real r;
    real dr;
};

FN BulbTangent bulb_tangent(vec3 axis, real r_slope)
{
    BulbTangent v;
    v.z = axis;
    v.r = r_slope;
    v.dr = 0;
    return v;
}

// One iteration of a tangent: the chain rule through (r, 0, 1), each angle's slope taken from z and dz; on the axis the
// azimuth stands still.
FN BulbTangent bulb_advance(Scene scene, BulbTangent v, vec3 axis, vec3 z, real per_r2, real dr, BulbPower power)
{
    mask off_axis = power.rho * power.rho > 2 * axis_radius2();
    real d_rho = pick(off_axis, (z.x * v.z.x + z.y * v.z.y) * power.per_rho, v.z.x);
    real d_polar = (z.z * d_rho - power.rho * v.z.z) * per_r2;
    real d_azimuth = pick(off_axis, (z.x * v.z.y - z.y * v.z.x) * power.per_rho * power.per_rho, R(0.0));
    real d_ln_r = inner(z, v.z) * per_r2;
    // Slopes of polar and azimuth, both without the factor P.
    Complex polar = complex_number(power.polar.re * d_ln_r - power.polar.im * d_polar,
                                   power.polar.im * d_ln_r + power.polar.re * d_polar);
    Complex azimuth = complex_number(-power.azimuth.im * d_azimuth, power.azimuth.re * d_azimuth);
    vec3 d = vec3(polar.im * power.azimuth.re + power.polar.im * azimuth.re,
                  polar.im * power.azimuth.im + power.polar.im * azimuth.im, polar.re);
    BulbTangent next;
    next.z = along(axis, d, bulb_power(scene));
    next.r = 0;
    next.dr = bulb_power(scene) * power.r_less * ((bulb_power(scene) - 1) * d_ln_r * dr + v.dr);
    return next;
}

FN BulbTangent bulb_pick(mask on, BulbTangent a, BulbTangent b)
{
    BulbTangent v;
    v.z = pick3(on, a.z, b.z);
    v.r = pick(on, a.r, b.r);
    v.dr = pick(on, a.dr, b.dr);
    return v;
}

// The derivative of DE, times dr > 0.
FN real bulb_slope(real r, real dr, real ln_r, BulbTangent v)
{
    return quick_quotient((ln_r + 1) * v.r, dr) - quick_quotient(ln_r * r, dr) * quick_quotient(v.dr, dr);
}

// The gradient of DE up to a positive factor, by forward differentiation of estimate() along the three axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real dr = 1;
    real r = quick_norm(z);
    BulbTangent x = bulb_tangent(vec3(1, 0, 0), quick_quotient(z.x, r));
    BulbTangent y = bulb_tangent(vec3(0, 1, 0), quick_quotient(z.y, r));
    BulbTangent w = bulb_tangent(vec3(0, 0, 1), quick_quotient(z.z, r));
    on = on && r <= bulb_bailout(scene);
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        BulbPower power = bulb_raised(scene, z, r, r * r);
        real per_r2 = quick_quotient(1, r * r);
        BulbTangent next_x = bulb_advance(scene, x, vec3(1, 0, 0), z, per_r2, dr, power);
        BulbTangent next_y = bulb_advance(scene, y, vec3(0, 1, 0), z, per_r2, dr, power);
        BulbTangent next_w = bulb_advance(scene, w, vec3(0, 0, 1), z, per_r2, dr, power);
        dr = pick(on, dr * (power.r_less * bulb_power(scene)) + 1, dr);
        z = pick3(on, bulb_next(power, p), z);
        i = i + 1;
        // The slope of the radius, like the radius, is not taken after the last iteration.
        if (i < scene.max_iterations) {
            r = pick(on, quick_norm(z), r);
            real per_r = quick_quotient(1, r);
            next_x.r = inner(z, next_x.z) * per_r;
            next_y.r = inner(z, next_y.z) * per_r;
            next_w.r = inner(z, next_w.z) * per_r;
        } else {
            next_x.r = x.r;
            next_y.r = y.r;
            next_w.r = w.r;
        }
        x = bulb_pick(on, next_x, x);
        y = bulb_pick(on, next_y, y);
        w = bulb_pick(on, next_w, w);
        on = on && r <= bulb_bailout(scene);
    }
    real ln_r = natural_log(r);
    return vec3(bulb_slope(r, dr, ln_r, x), bulb_slope(r, dr, ln_r, y), bulb_slope(r, dr, ln_r, w));
}

// The share of light that haze takes on a way of length t: half at about the fractal's size.
FN real haze(real t) { return quotient(t, t + R(1.6)); }

// Where the orbit of p passes nearest to x = 0, to z = 0 and to the middle, for colours: |x|, |z|, r^2. A few
// iterations, so that colours are smooth at the scale of a picture.
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
