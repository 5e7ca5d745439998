// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 8: from a ray's hit to a pixel's colour.

struct Normal {
    vec3 direction;  // unit vector
    effort estimates;
    effort iterations;
};

// The gradient of DE by central differences, six estimates; the step is relative to the larger of |p| and 1.
FN Normal normal_by_differences(Scene scene, vec3 p, mask on)
{
    real h = larger(norm(p), 1) * scene.difference_step;
    vec3 slope = vec3(0, 0, 0);
    Normal normal;
    normal.estimates = 0;
    normal.iterations = 0;
    int axis = 0;
    while (axis < 3) {
        vec3 ahead = p;
        vec3 behind = p;
        if (axis == 0) {
            ahead.x = p.x + h;
            behind.x = p.x - h;
        } else if (axis == 1) {
            ahead.y = p.y + h;
            behind.y = p.y - h;
        } else {
            ahead.z = p.z + h;
            behind.z = p.z - h;
        }
        Estimate a = estimate(scene, ahead, on);
        Estimate b = estimate(scene, behind, on);
        real difference = a.distance - b.distance;
        if (axis == 0) slope.x = difference;
        if (axis == 1) slope.y = difference;
        if (axis == 2) slope.z = difference;
        normal.estimates = tally(tally(normal.estimates, on), on);
        normal.iterations = normal.iterations + a.iterations + b.iterations;
        axis = axis + 1;
    }
    normal.direction = unit(slope);
    return normal;
}

FN Normal normal_at(Scene scene, vec3 p, mask on)
{
    Normal normal;
    normal.estimates = 0;
    normal.iterations = 0;
    if (scene.differences != 0) {
        normal = normal_by_differences(scene, p, on);
    } else {
        normal.direction = unit(gradient(scene, p, on));
        normal.estimates = tally(normal.estimates, on);
    }
    return normal;
}

// (light n + 1) / 2 * brightness, cut to [0, 1] and squared; 0 where it is not a number.
FN real channel(Scene scene, real light, real n)
{
    real c = (light * n + 1) * R(0.5) * scene.brightness;
    c = pick(c > 0, pick(c < 1, c, R(1.0)), R(0.0));
    return c * c;
}

// The original program's light: colour is the normal itself, lit by the view's angle to it.
FN vec3 lit(Scene scene, vec3 direction, vec3 n)
{
    real light = R(1.8) * larger(inner(minus(n, vec3(1, 1, 1)), direction), R(0.3));
    vec3 colour = vec3(channel(scene, light, n.x), channel(scene, light, n.y), channel(scene, light, n.z));
    if (scene.colouring == 1) colour = vec3(colour.z, colour.y, colour.x);
    return colour;
}

// The pixel of a ray that has ended and hit nothing.
FN Pixel missed(Scene scene, Ray ray)
{
    Pixel pixel;
    pixel.colour = vec3(R(0.4), R(0.4), R(0.4));
    if (scene.colouring > 1) pixel.colour = displayed3(scene, sky(scene, ray.direction));
    pixel.depth = scene.miss;
    pixel.steps = ray.steps;
    pixel.estimates = ray.estimates;
    pixel.iterations = ray.iterations;
    return pixel;
}

// The normal n of a hit at t, but an eye in the solid sees no surface: in a canonical picture what it sees faces it.
// shade_with() asks for it where it needs it, twice: asked once before, it costs the K40 three registers.
FN vec3 facing(Scene scene, vec3 direction, vec3 n, real t)
{
    if (scene.canonical != 0) n = pick3(t > 0, n, times(R(-1.0), direction));
    return n;
}

// Where a hit is shaded: at t, with the normal of p, one tolerance before it.
struct ShadingPoint {
    real t;
    vec3 p;
};

FN ShadingPoint shading_point(Scene scene, Ray ray)
{
    ShadingPoint at;
    at.t = landing(scene, ray);
    real back = scene.tolerance * at.t;
    if (scene.canonical == 0) back = tolerance(scene, ray);
    at.p = along(point_at(scene, ray, at.t), ray.direction, -back);
    return at;
}

// The pixel of a miss becomes that of a hit where the ray has hit, by the normal at its shading point.
FN Pixel shade_with(Scene scene, Ray ray, Pixel pixel, ShadingPoint at, Normal normal)
{
    mask hit = has_hit(scene, ray);
    if (scene.colouring > 1) {
        vec3 n = facing(scene, ray.direction, normal.direction, at.t);
        Look seen = look(scene, ray.direction, at.p, n, at.t, hit);
        pixel.colour = pick3(hit, seen.colour, pixel.colour);
        pixel.estimates = pixel.estimates + seen.estimates;
        pixel.iterations = pixel.iterations + seen.iterations;
    } else {
        vec3 n = facing(scene, ray.direction, normal.direction, at.t);
        pixel.colour = pick3(hit, lit(scene, ray.direction, n), pixel.colour);
    }
    pixel.depth = pick(hit, at.t, pixel.depth);
    pixel.estimates = pixel.estimates + normal.estimates;
    pixel.iterations = pixel.iterations + normal.iterations;
    return pixel;
}

// A ray that has ended, to its pixel.
FN Pixel shade(Scene scene, Ray ray)
{
    mask hit = has_hit(scene, ray);
    Pixel pixel = missed(scene, ray);
    if (any(hit)) {
        ShadingPoint at = shading_point(scene, ray);
        Normal normal = normal_at(scene, at.p, hit);
        pixel = shade_with(scene, ray, pixel, at, normal);
    }
    return pixel;
}

// The whole pixel in one go.
FN Pixel draw(Scene scene, real i, real j)
{
    Ray ray = march(scene, begin(scene, i, j), scene.max_steps);
    if (scene.canonical != 0) ray = refine(scene, ray);
    return shade(scene, ray);
}
