// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 7: the directions of rays from the camera.

// Returns the position of pixel `at` in a row or column of `size` pixels, from -1 to 1. Uses
// quotient(), not quick_quotient(), because the last bits affect the picture.
FN real picture_place(real at, scalar size) { return quotient(2 * at, size) - 1; }

// Returns the direction through (u, v) of a perspective picture, not normalised. v = -1 is the bottom.
FN vec3 perspective(Scene scene, real u, real v)
{
    return along(along(splat(scene.forward), splat(scene.across), u), splat(scene.upward), v);
}

// Returns the sum of the camera's axes, scaled by the factor `a` of a column and the factor `b` of a row: a.re b.re
// forward + a.im b.re across + b.im upward. For a perspective picture, a = (1, u) and b = (1, v).
FN vec3 along_axes(Scene scene, Complex a, Complex b)
{
    vec3 level = along(times(a.re, splat(scene.forward)), splat(scene.across), a.im);
    return along(times(b.re, level), splat(scene.upward), b.im);
}

// column_of() and row_of() return the factors of a column and a row of an equirectangular picture. With them, the
// direction has length 1 up to rounding.
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
