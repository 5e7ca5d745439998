// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 12: computes the colour of a pixel from its hit.

struct Normal {
    vec3 direction;  // unit vector
    counter de_calls;
    counter iterations;
};

// Returns the normal, which is the direction of the gradient of DE. Computes it by central differences, with six DE
// evaluations.
FN Normal normal_by_differences(Scene scene, vec3 p, mask on)
{
    real h = larger(norm(p), 1) * scene.difference_step;
    vec3 slope = vec3(0, 0, 0);
    Normal normal;
    normal.de_calls = 0;
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
        normal.de_calls = tally(tally(normal.de_calls, on), on);
        normal.iterations = normal.iterations + a.iterations + b.iterations;
        axis = axis + 1;
    }
    normal.direction = unit(slope);
    return normal;
}

// Returns the normal, which is the direction of the gradient of DE. Computes it from four DE evaluations, at the
// corners of a tetrahedron, which are at distance h from p. Details smaller than h have no effect, so the normals of
// adjacent pixels are similar.
FN Normal normal_by_tetrahedron(Scene scene, vec3 p, real h, mask on)
{
    vec3 slope = vec3(0, 0, 0);
    Normal normal;
    normal.de_calls = 0;
    normal.iterations = 0;
    int corner = 0;
    while (corner < 4) {
        // The corners (1, 1, 1), (1, -1, -1), (-1, 1, -1) and (-1, -1, 1), divided by sqrt(3), as unit vectors.
        scalar x = corner < 2 ? R(0.57735026918962576) : R(-0.57735026918962576);
        scalar y = corner == 0 || corner == 2 ? R(0.57735026918962576) : R(-0.57735026918962576);
        scalar z = corner == 0 || corner == 3 ? R(0.57735026918962576) : R(-0.57735026918962576);
        vec3 towards = vec3(x, y, z);
        Estimate there = estimate(scene, along(p, towards, h), on);
        slope = along(slope, towards, there.distance);
        normal.de_calls = tally(normal.de_calls, on);
        normal.iterations = normal.iterations + there.iterations;
        corner = corner + 1;
    }
    normal.direction = unit(slope);
    return normal;
}

// Returns the normal at p, the shading point of a hit at distance t.
FN Normal normal_at(Scene scene, vec3 p, real t, mask on)
{
    Normal normal;
    normal.de_calls = 0;
    normal.iterations = 0;
    if (scene.differences == 1) {
        normal = normal_by_differences(scene, p, on);
#ifdef MM_NO_GRADIENT
    } else {
        normal = normal_by_tetrahedron(scene, p, (scene.differences == 2 ? R(1.0) : R(0.03)) * scene.tolerance * t, on);
    }
#else
    } else if (scene.differences == 2) {
        normal = normal_by_tetrahedron(scene, p, scene.tolerance * t, on);
    } else {
        normal.direction = unit(gradient(scene, p, on));
        normal.de_calls = tally(normal.de_calls, on);
    }
#endif
    return normal;
}

// Returns (light n + 1) / 2 * brightness, clamped to [0, 1] and squared; 0 for NaN.
FN real channel(Scene scene, real light, real n)
{
    real c = (light * n + 1) * R(0.5) * scene.brightness;
    c = pick(c > 0, pick(c < 1, c, R(1.0)), R(0.0));
    return c * c;
}

// Returns the colour that the original program computes from the components of the normal and from a light term, which
// depends on the normal and the view direction.
FN vec3 lit(Scene scene, vec3 direction, vec3 n)
{
    real light = R(1.8) * larger(dot3(minus(n, vec3(1, 1, 1)), direction), R(0.3));
    vec3 colour = vec3(channel(scene, light, n.x), channel(scene, light, n.y), channel(scene, light, n.z));
    if (scene.colouring == 1) colour = vec3(colour.z, colour.y, colour.x);
    return colour;
}

// Returns the pixel of a ray without a hit.
FN Pixel missed(Scene scene, Hit hit)
{
    Pixel pixel;
    pixel.colour = vec3(R(0.4), R(0.4), R(0.4));
    if (has_look(scene) != 0) {
        pixel.colour = grained(scene, displayed3(scene, backdrop(scene, hit.direction)), hit.direction);
    }
    pixel.depth = scene.miss;
    pixel.steps = hit.steps;
    pixel.de_calls = hit.de_calls;
    pixel.iterations = hit.iterations;
    return pixel;
}

// Returns the normal of a hit at distance t. If the eye is inside the solid (t = 0), the hit is not on the surface; in
// canonical pictures its normal is then the direction towards the eye.
FN vec3 facing(Scene scene, vec3 direction, vec3 n, real t)
{
    if (scene.canonical != 0) n = pick3(t > 0, n, times(R(-1.0), direction));
    return n;
}

// The shading point of a hit at distance t. It lies one tolerance in front of the hit; the normal is evaluated there.
struct ShadingPoint {
    real t;
    vec3 p;
};

FN ShadingPoint shading_point(Scene scene, Hit hit)
{
    ShadingPoint at;
    at.t = landing(scene, hit);
    real back = scene.tolerance * at.t;
    if (scene.canonical == 0) back = hit.t * scene.tolerance;
    at.p = along(along(splat(scene.eye), hit.direction, at.t), hit.direction, -back);
    return at;
}

// Adds the depth of a hit and the work of its normal to its pixel.
FN Pixel finished(Hit hit, Pixel pixel, ShadingPoint at, Normal normal)
{
    pixel.depth = pick(is_hit(hit), at.t, pixel.depth);
    pixel.de_calls = pixel.de_calls + normal.de_calls;
    pixel.iterations = pixel.iterations + normal.iterations;
    return pixel;
}

// Returns the pixel of a hit, shaded with a look and the given openness. If the ray has no hit, returns `pixel`
// unchanged.
FN Pixel shade_among(Scene scene, Hit hit, Pixel pixel, ShadingPoint at, Normal normal, Occlusion found)
{
    mask on = is_hit(hit);
    vec3 n = facing(scene, hit.direction, normal.direction, at.t);
    Look seen = look(scene, hit.direction, at.p, n, at.t, found, on);
    pixel.colour = pick3(on, seen.colour, pixel.colour);
    pixel.de_calls = pixel.de_calls + seen.de_calls;
    pixel.iterations = pixel.iterations + seen.iterations;
    return finished(hit, pixel, at, normal);
}

// Returns the pixel of a hit, shaded with the normal at its shading point. If the ray has no hit, returns `pixel`
// unchanged.
FN Pixel shade_with(Scene scene, Hit hit, Pixel pixel, ShadingPoint at, Normal normal)
{
    mask on = is_hit(hit);
    vec3 n = facing(scene, hit.direction, normal.direction, at.t);
    if (has_look(scene) != 0) {
        pixel = shade_among(scene, hit, pixel, at, normal, occlusion(scene, at.p, n, at.t, on));
    } else {
        pixel.colour = pick3(on, lit(scene, hit.direction, n), pixel.colour);
        pixel = finished(hit, pixel, at, normal);
    }
    return pixel;
}

// Returns the pixel of a stopped ray.
FN Pixel shade(Scene scene, Hit hit)
{
    mask on = is_hit(hit);
    Pixel pixel = missed(scene, hit);
    if (any(on)) {
        ShadingPoint at = shading_point(scene, hit);
        Normal normal = normal_at(scene, at.p, at.t, on);
        pixel = shade_with(scene, hit, pixel, at, normal);
    }
    return pixel;
}

// Returns the pixel of a ray that has stopped.
FN Pixel drawn(Scene scene, Ray ray)
{
    Hit hit = stopped(scene, ray);
    if (scene.canonical != 0) hit = refine(scene, hit);
    return shade(scene, hit);
}

// Renders a pixel completely.
FN Pixel draw(Scene scene, real i, real j) { return drawn(scene, march(scene, begin(scene, i, j), scene.max_steps)); }
