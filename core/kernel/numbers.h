// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 3: elementary functions, computed from + - *, quotient(), root(), nearest(), exponent_of() and
// two_to(). They return the same bits on every device. GLSL has no such functions in double, and libraries differ in
// rounding. Every polynomial is a Taylor series, cut where its remainder is below 2^-56 of the result (in double).

// Returns the natural logarithm of x; -1e30 for x <= 0. With x = 2^e m and m in [1/sqrt 2, sqrt 2], ln m = 2 artanh
// s, where s = (m - 1) / (m + 1) and |s| <= 0.1716. ln 2 is split into two parts. The first
// has so few bits that its product with e is exact.
FN real natural_log(real x)
{
    real e = exponent_of(x);
    real m = x * two_to(-e);
    mask high = m > R(1.4142135623730951);
    m = pick(high, m * R(0.5), m);
    e = pick(high, e + 1, e);
    real s = quick_quotient(m - 1, m + 1);
    real q = s * s;
#if MM_REAL_IS_FLOAT
    real series = R(0.1111111111111111);  // 1/9
#else
    real series = R(0.043478260869565216);          // 1/23
    series = series * q + R(0.047619047619047616);  // 1/21
    series = series * q + R(0.052631578947368418);  // 1/19
    series = series * q + R(0.058823529411764705);  // 1/17
    series = series * q + R(0.066666666666666667);  // 1/15
    series = series * q + R(0.076923076923076927);  // 1/13
    series = series * q + R(0.090909090909090912);  // 1/11
    series = series * q + R(0.1111111111111111);    // 1/9
#endif
    series = series * q + R(0.14285714285714285);  // 1/7
    series = series * q + R(0.2);                  // 1/5
    series = series * q + R(0.33333333333333331);  // 1/3
    real twice = s + s;
    real ln_m = twice + twice * (q * series);
    real ln_x = e * BY_PRECISION(0.69314718036912382, 0.693359375) +
                (e * BY_PRECISION(1.9082149292705877e-10, -2.12194440e-4) + ln_m);
    return pick(x > 0, ln_x, R(-1.0e30));
}

#ifndef MM_HAS_ROUGH_LOG
FN real rough_log(real x) { return natural_log(x); }
#endif

// Returns e^x, with x clamped so that the result is a normal number. Uses x = k ln 2 + r with |r| <= ln 2 / 2.
FN real exponential(real x)
{
    x = larger(smaller(x, BY_PRECISION(708.0, 87.0)), BY_PRECISION(-708.0, -87.0));
    real k = nearest(x * R(1.4426950408889634));
    real r = (x - k * BY_PRECISION(0.69314718036912382, 0.693359375)) -
             k * BY_PRECISION(1.9082149292705877e-10, -2.12194440e-4);
    real series = R(1.6059043836821613e-10);          // 1/13!
    series = series * r + R(2.08767569878681e-09);    // 1/12!
    series = series * r + R(2.505210838544172e-08);   // 1/11!
    series = series * r + R(2.7557319223985888e-07);  // 1/10!
    series = series * r + R(2.7557319223985893e-06);  // 1/9!
    series = series * r + R(2.4801587301587302e-05);  // 1/8!
    series = series * r + R(0.00019841269841269841);  // 1/7!
    series = series * r + R(0.0013888888888888889);   // 1/6!
    series = series * r + R(0.0083333333333333332);   // 1/5!
    series = series * r + R(0.041666666666666664);    // 1/4!
    series = series * r + R(0.16666666666666666);     // 1/3!
    series = series * r + R(0.5);
    return two_to(k) * (1 + (r + r * r * series));
}

// Returns cos x + i sin x, for |x| up to about 10^5 in double and 10^3 in float. Uses x = k pi/2 + r with |r| <= pi/4.
// pi/2 is split into three parts, so that their products with k are exact (Cody and Waite, Software Manual for the
// Elementary Functions, 1980).
FN Complex cosine_and_sine(real x)
{
    real k = nearest(x * R(0.63661977236758138));
    real r = ((x - k * BY_PRECISION(1.5707963267341256, 1.5703125)) -
              k * BY_PRECISION(6.077100506303966e-11, 4.837512969970703125e-4)) -
             k * BY_PRECISION(2.0222662487959506e-21, 7.549789948768648e-8);
    real q = r * r;
    real sine = R(2.8114572543455206e-15);        // 1/17!
    sine = sine * q - R(7.6471637318198164e-13);  // 1/15!
    sine = sine * q + R(1.6059043836821613e-10);  // 1/13!
    sine = sine * q - R(2.505210838544172e-08);   // 1/11!
    sine = sine * q + R(2.7557319223985893e-06);  // 1/9!
    sine = sine * q - R(0.00019841269841269841);  // 1/7!
    sine = sine * q + R(0.0083333333333333332);   // 1/5!
    sine = sine * q - R(0.16666666666666666);     // 1/3!
    sine = r + r * (q * sine);
    real cosine = R(4.7794773323873853e-14);          // 1/16!
    cosine = cosine * q - R(1.1470745597729725e-11);  // 1/14!
    cosine = cosine * q + R(2.08767569878681e-09);    // 1/12!
    cosine = cosine * q - R(2.7557319223985888e-07);  // 1/10!
    cosine = cosine * q + R(2.4801587301587302e-05);  // 1/8!
    cosine = cosine * q - R(0.0013888888888888889);   // 1/6!
    cosine = cosine * q + R(0.041666666666666664);    // 1/4!
    cosine = cosine * q - R(0.5);
    cosine = 1 + q * cosine;
    // The quadrant is k modulo 4, as a number from -2 to 2: 3 appears as -1, and 2 appears as -2 or 2.
    real quadrant = k - 4 * nearest(k * R(0.25));
    mask odd = magnitude(quadrant) == 1;
    mask sine_negative = quadrant == -1 || magnitude(quadrant) == 2;
    mask cosine_negative = quadrant == 1 || magnitude(quadrant) == 2;
    real across = pick(odd, sine, cosine);
    real upward = pick(odd, cosine, sine);
    return complex_number(pick(cosine_negative, -across, across), pick(sine_negative, -upward, upward));
}

// Returns the angle of x + i y in (-pi, pi]; 0 at the origin. The angle is reduced to an octant, in which its tangent q
// is at most 1. Applying atan q = 2 atan(q / (1 + sqrt(1 + q^2))) twice reduces q to less than 0.199.
FN real angle_of(real y, real x)
{
    real ax = magnitude(x);
    real ay = magnitude(y);
    mask steep = ay > ax;
    real denominator = pick(steep, ay, ax);
    real q = quotient(pick(steep, ax, ay), pick(denominator > 0, denominator, 1));
    q = quotient(q, 1 + root(1 + q * q));
    q = quotient(q, 1 + root(1 + q * q));
    real s = q * q;
    real series = R(0.04);                          // 1/25
    series = series * s - R(0.043478260869565216);  // 1/23
    series = series * s + R(0.047619047619047616);
    series = series * s - R(0.052631578947368418);
    series = series * s + R(0.058823529411764705);
    series = series * s - R(0.066666666666666667);
    series = series * s + R(0.076923076923076927);
    series = series * s - R(0.090909090909090912);
    series = series * s + R(0.1111111111111111);
    series = series * s - R(0.14285714285714285);
    series = series * s + R(0.2);
    series = series * s - R(0.33333333333333331);  // 1/3
    real angle = 4 * (q + q * (s * series));
    angle = pick(steep, R(1.5707963267948966) - angle, angle);
    angle = pick(x < 0, R(3.1415926535897931) - angle, angle);
    return pick(y < 0, -angle, angle);
}
