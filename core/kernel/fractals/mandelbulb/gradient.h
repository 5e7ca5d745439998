// SPDX-License-Identifier: Apache-2.0
// The gradient of the Mandelbulb's DE, for normals. Included by mandelbulb.h.

// Derivatives of z and of dr along one coordinate axis of the point p.
struct BulbTangent {
    vec3 z;
    real dr;
};

FN BulbTangent bulb_tangent(vec3 axis)
{
    BulbTangent v;
    v.z = axis;
    v.dr = 0;
    return v;
}

// Terms of one iteration that are the same for all three tangents. theta and phi are the angles of mandelbulb.h.
struct BulbStep {
    mask off_axis;  // lanes whose point is not on the z axis
    real cosine;    // cos(phi)
    real sine;      // sin(phi)
    real rho;
    real z;
    Complex polar;    // P r^(P-2) (cos(P theta) + i sin(P theta))
    Complex azimuth;  // cos(P phi) + i sin(P phi)
    real spin;        // P r^P sin(P theta) / rho
    real growth;      // P r^(P-1)
    real bend;        // P (P-1) r^(P-3) dr
};

FN BulbStep bulb_step(Scene scene, vec3 z, real r2, real dr, BulbPower power)
{
    real per_r2 = quick_quotient(1, r2);
    real scale = bulb_power(scene) * per_r2;
    BulbStep step;
    step.off_axis = power.rho * power.rho > 2 * axis_radius2();
    step.cosine = z.x * power.per_rho;
    step.sine = z.y * power.per_rho;
    step.rho = power.rho;
    step.z = z.z;
    step.polar = complex_number(power.polar.re * scale, power.polar.im * scale);
    step.azimuth = power.azimuth;
    step.spin = bulb_power(scene) * power.polar.im * power.per_rho;
    step.growth = bulb_power(scene) * power.r_less;
    step.bend = (bulb_power(scene) - 1) * step.growth * dr * per_r2;
    return step;
}

// Computes one iteration of a tangent by the chain rule through (r, theta, phi). The changes of these three are
// computed from z and its derivative, without the angles themselves. On the z axis the azimuth is taken as constant.
FN BulbTangent bulb_advance(BulbTangent v, vec3 axis, BulbStep step)
{
    real d_rho = pick(step.off_axis, step.cosine * v.z.x + step.sine * v.z.y, v.z.x);
    real turn = pick(step.off_axis, step.cosine * v.z.y - step.sine * v.z.x, R(0.0));  // rho times the change of phi
    real outward = step.z * v.z.z + step.rho * d_rho;                                  // r times the change of r
    real across = step.z * d_rho - step.rho * v.z.z;                                   // r^2 times the change of theta
    real im = step.polar.im * outward + step.polar.re * across;
    real spin = step.spin * turn;
    BulbTangent next;
    next.z = vec3(im * step.azimuth.re - spin * step.azimuth.im + axis.x,
                  im * step.azimuth.im + spin * step.azimuth.re + axis.y,
                  step.polar.re * outward - step.polar.im * across + axis.z);
    next.dr = step.growth * v.dr + step.bend * outward;
    return next;
}

// Returns the derivative of DE along v, multiplied by dr, which is positive.
FN real bulb_slope(vec3 z, real r, real dr, real ln_r, BulbTangent v)
{
    real d_r = quick_quotient(dot3(z, v.z), r);
    return quick_quotient((ln_r + 1) * d_r, dr) - quick_quotient(ln_r * r, dr) * quick_quotient(v.dr, dr);
}

// Returns the gradient of DE up to a positive factor. Differentiates estimate() in forward mode along the three axes.
FN_CALLED vec3 gradient(Scene scene, vec3 p, mask on)
{
    vec3 z = p;
    real dr = 1;
    real r = quick_norm(z);
    BulbTangent x = bulb_tangent(vec3(1, 0, 0));
    BulbTangent y = bulb_tangent(vec3(0, 1, 0));
    BulbTangent w = bulb_tangent(vec3(0, 0, 1));
    on = on && r <= bulb_bailout(scene);
    int i = 0;
    while (i < scene.max_iterations && any(on)) {
        real r2 = r * r;
        BulbPower power = bulb_raised(scene, z, r, r2);
        BulbStep step = bulb_step(scene, z, r2, dr, power);
        BulbTangent next_x = bulb_advance(x, vec3(1, 0, 0), step);
        BulbTangent next_y = bulb_advance(y, vec3(0, 1, 0), step);
        BulbTangent next_w = bulb_advance(w, vec3(0, 0, 1), step);
        x.dr = pick(on, next_x.dr, x.dr);
        y.dr = pick(on, next_y.dr, y.dr);
        w.dr = pick(on, next_w.dr, w.dr);
        dr = pick(on, dr * step.growth + 1, dr);
        i = i + 1;
        // As in estimate(), the last iteration does not update the point and its radius.
        if (i < scene.max_iterations) {
            x.z = pick3(on, next_x.z, x.z);
            y.z = pick3(on, next_y.z, y.z);
            w.z = pick3(on, next_w.z, w.z);
            z = pick3(on, bulb_next(power, p), z);
            r = quick_norm(z);
        }
        on = on && r <= bulb_bailout(scene);
    }
    real ln_r = natural_log(r);
    return vec3(bulb_slope(z, r, dr, ln_r, x), bulb_slope(z, r, dr, ln_r, y), bulb_slope(z, r, dr, ln_r, w));
}
