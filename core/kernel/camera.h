// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 7: the camera's directions.

// Where pixel number `at` of `size` in a row or a column lies in the picture, from -1 to 1. The last bits show.
FN real picture_place(real at, scalar size) { return quotient(2 * at, size) - 1; }

// Through (u, v) of a perspective picture; v = -1 is the bottom. Of no particular length.
FN vec3 perspective(Scene scene, real u, real v)
{
    return along(along(wide(scene.forward), wide(scene.across), u), wide(scene.upward), v);
}

// What a column and a row do to the camera's axes: forward times a.re b.re, across times a.im b.re, upward times b.im.
// In a perspective picture that is 1, u and v.
FN vec3 along_axes(Scene scene, Complex a, Complex b)
{
    vec3 level = along(times(a.re, wide(scene.forward)), wide(scene.across), a.im);
    return along(times(b.re, level), wide(scene.upward), b.im);
}

// Through (u, v) of an equirectangular picture: of length 1 but for rounding.
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
