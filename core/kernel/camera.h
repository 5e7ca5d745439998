// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 7: directions from the camera.

// Maps pixel `at` of `size` in a row or a column to -1 to 1. Exact division, because the last bits affect the picture.
FN real picture_place(real at, scalar size) { return quotient(2 * at, size) - 1; }

// Direction through (u, v) of a perspective picture, not normalised; v = -1 is the bottom.
FN vec3 perspective(Scene scene, real u, real v)
{
    return along(along(splat(scene.forward), splat(scene.across), u), splat(scene.upward), v);
}

// Scales the camera's axes by a column's and a row's factors and adds them: forward times a.re b.re, across times a.im
// b.re, upward times b.im. The factors of a perspective picture are 1, u and v.
FN vec3 along_axes(Scene scene, Complex a, Complex b)
{
    vec3 level = along(times(a.re, splat(scene.forward)), splat(scene.across), a.im);
    return along(times(b.re, level), splat(scene.upward), b.im);
}

// Factors of a column and a row of an equirectangular picture; the direction then has length 1 up to rounding.
FN Complex column_of(Scene scene, real u)
{
    Complex angle = cosine_and_sine(scene.longitudes * u + scene.longitude);
    return complex_number(angle.re, quotient(angle.im, scene.longitudes));
}

FN Complex row_of(Scene scene, real v)
{
    Complex angle = cosine_and_sine(scene.latitudes * v + scene.latitude);
    return complex_number(angle.re, quotient(angle.im, scene.latitudes));
}

FN_CALLED vec3 equirectangular(Scene scene, real u, real v)
{
    return along_axes(scene, column_of(scene, u), row_of(scene, v));
}
