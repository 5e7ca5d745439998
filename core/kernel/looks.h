// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 11: looks, which are the colouring types 2 and above. Colours are linear light until displayed()
// converts them.
//   2 limestone  warm stone under a cool sky
//   3 coral      the orbit trap's colours under the same light
//   4 lagoon     dark water, with a lamp at the camera
// All looks have haze, ambient occlusion and a soft key light. The occlusion and the softness are computed from
// estimates at a few points along a line (Evans, "Fast approximations for global illumination on dynamic scenes",
// SIGGRAPH 2006 course).

FN real saturated(real x) { return pick(x > 0, pick(x < 1, x, R(1.0)), R(0.0)); }

// Returns the linear interpolation from a (s = 0) to b (s = 1).
FN vec3 blend(vec3 a, vec3 b, real s) { return along(times(1 - s, a), b, s); }

FN vec3 scaled(vec3 a, vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }

struct Openness {
    real share;  // mean over the four points; 0: enclosed, 1: open
    real least;  // min over the four points
    counter de_calls;
    counter iterations;
};

// Returns the openness, which is 1 - occlusion, at p in the direction n. It is computed from the ratio of the estimate
// to the distance from p, at four points from 0.4 to 9 % of t away from p. The estimate is usually smaller than the
// distance to the surface, often a third of it, so a ratio of one half already counts as open.
FN Openness openness(Scene scene, vec3 p, vec3 n, real t, mask on)
{
    Openness result;
    result.share = 0;
    result.least = 1;
    result.de_calls = 0;
    result.iterations = 0;
    real h = t * R(0.004);
    int i = 0;
    while (i < 4) {
        Estimate there = estimate(scene, along(p, n, h), on);
        real open = saturated(quotient(2 * there.distance, h));
        result.share = result.share + R(0.25) * open;
        result.least = pick(open < result.least, open, result.least);
        result.de_calls = tally(result.de_calls, on);
        result.iterations = result.iterations + there.iterations;
        h = h * R(2.85);
        i = i + 1;
    }
    return result;
}

// Returns the albedo of the surface, a mix of colours selected by the orbit trap.
FN vec3 albedo(Scene scene, vec3 trap)
{
    vec3 colour = blend(vec3(R(0.62), R(0.52), R(0.40)), vec3(R(0.40), R(0.28), R(0.20)), saturated(trap.z));
    if (scene.colouring == 3) {
        colour = blend(vec3(R(0.88), R(0.20), R(0.08)), vec3(R(0.84), R(0.62), R(0.40)), saturated(R(2.5) * trap.x));
        colour = blend(colour, vec3(R(0.03), R(0.40), R(0.44)), saturated(R(2.5) * trap.x - 1));
        colour = blend(colour, vec3(R(0.80), R(0.54), R(0.22)), saturated(R(0.9) - 3 * trap.y));
        colour = blend(colour, vec3(R(0.16), R(0.03), R(0.10)), R(0.7) * saturated(trap.z));
    }
    if (scene.colouring == 4) {
        colour = blend(vec3(R(0.05), R(0.55), R(0.50)), vec3(R(0.65), R(0.60), R(0.30)), saturated(trap.x));
        colour = blend(colour, vec3(R(0.10), R(0.12), R(0.45)), saturated(trap.z));
    }
    return colour;
}

// Returns the colour of a ray without a hit. It is also the colour of the haze in that direction.
FN vec3 sky(Scene scene, vec3 direction)
{
    vec3 zenith = vec3(R(0.10), R(0.24), R(0.55));
    vec3 horizon = vec3(R(0.42), R(0.50), R(0.58));
    vec3 glow = vec3(R(0.80), R(0.66), R(0.44));
    if (scene.colouring == 3) {
        zenith = vec3(R(0.04), R(0.09), R(0.22));
        horizon = vec3(R(0.42), R(0.32), R(0.30));
        glow = vec3(R(0.95), R(0.58), R(0.26));
    }
    if (scene.colouring == 4) {
        zenith = vec3(R(0.00), R(0.02), R(0.06));
        horizon = vec3(R(0.01), R(0.10), R(0.15));
        glow = vec3(R(0.02), R(0.16), R(0.16));
    }
    // The sky is brighter at the horizon and darker above and below. The sun has a wide and a narrow halo.
    real low = 1 - direction.y * direction.y;
    low = low * low;
    low = low * low;
    real near = saturated(dot3(direction, splat(scene.sun)));
    near = near * near;
    real wide_halo = near * near;
    real halo = wide_halo * wide_halo;
    halo = halo * halo;
    halo = halo * halo;
    return along(blend(zenith, horizon, low), glow, R(0.30) * wide_halo + R(0.6) * halo);
}

// Converts linear light to a display value: applies the brightness, a film curve (Narkowicz, "ACES filmic tone mapping
// curve", 2016), and a gamma of 2.
FN real displayed(Scene scene, real light)
{
    real x = R(0.8) * scene.brightness * light;
    return root(saturated(quotient(x * (R(2.51) * x + R(0.03)), x * (R(2.43) * x + R(0.59)) + R(0.14))));
}

struct Look {
    vec3 colour;
    counter de_calls;
    counter iterations;
};

FN vec3 displayed3(Scene scene, vec3 light)
{
    return vec3(displayed(scene, light.x), displayed(scene, light.y), displayed(scene, light.z));
}

// Openness at a hit. Its evaluation is the most expensive part of a look, and it varies little between neighbouring
// pixels of a surface.
struct Occlusion {
    real along_normal;  // 0: enclosed, 1: open
    real sunwards;      // the same in the direction of the sun, over four times the distance
    counter de_calls;
    counter iterations;
};

// Evaluates the openness at a hit. p is the point, n its unit normal, t its distance from the camera.
FN_CALLED Occlusion occlusion(Scene scene, vec3 p, vec3 n, real t, mask on)
{
    Openness along_normal = openness(scene, p, n, t, on);
    Openness sunwards = openness(scene, p, splat(scene.sun), 4 * t, on);
    Occlusion found;
    found.along_normal = along_normal.share;
    found.sunwards = R(0.5) * (sunwards.share + sunwards.least) * sunwards.share;
    found.de_calls = along_normal.de_calls + sunwards.de_calls;
    found.iterations = along_normal.iterations + sunwards.iterations;
    return found;
}

// Returns the colour of a hit at p with the unit normal n and the openness `found`.
FN_CALLED Look look(Scene scene, vec3 direction, vec3 p, vec3 n, real t, Occlusion found, mask on)
{
    // The following values are computed before the loop of the orbit trap, so that few registers are live during the
    // loop.
    vec3 sun = splat(scene.sun);
    real facing = saturated(-dot3(n, direction));
    real key = saturated(R(0.08) + R(0.92) * dot3(n, sun)) * found.sunwards;
    real shelter = found.along_normal * (R(0.35) + R(0.65) * found.along_normal);
    // Adds light from the sky, the ground and the sun, and a little from the camera.
    vec3 light = times(shelter * (R(0.55) + R(0.45) * n.y), vec3(R(0.28), R(0.39), R(0.60)));
    light = along(light, vec3(R(0.30), R(0.17), R(0.11)), shelter * (R(0.5) - R(0.5) * n.y));
    light = along(light, vec3(R(2.15), R(1.64), R(1.00)), key);
    light = along(light, vec3(R(0.20), R(0.18), R(0.17)), shelter * facing);
    real hazed = haze(t);
    if (scene.colouring == 4) {
        // A lamp at the camera: its light decreases with the distance, and surfaces at grazing angles stay dark.
        real fall = quotient(1 - hazed, 1 + 5 * hazed);
        light = times(shelter * (R(0.15) + facing * facing) * fall, vec3(R(1.8), R(1.65), R(1.3)));
        light = along(light, vec3(R(0.05), R(0.13), R(0.19)), shelter);
    }
    // A glint, where the normal is close to the direction halfway between the sun and the camera.
    real glint = saturated(dot3(n, unit(minus(sun, direction))));
    glint = glint * glint;
    glint = glint * glint;
    glint = glint * glint * glint * key;
    // The haze rises faster than haze(), and reaches half its maximum at about half the fractal's size, so that it also
    // shows depth inside the fractal.
    real air = quotient(5 * hazed, 1 + 4 * hazed);
    air = air * air * (scene.colouring == 4 ? R(0.5) : R(0.24));
    vec3 behind = sky(scene, direction);
    vec3 lit_stone = scaled(albedo(scene, orbit_trap(scene, p, on)), light);
    lit_stone = along(lit_stone, vec3(R(0.25), R(0.22), R(0.18)), glint);
    Look result;
    result.colour = displayed3(scene, blend(lit_stone, behind, air));
    // Counts the orbit trap as one more evaluation.
    result.de_calls = tally(found.de_calls, on);
    result.iterations = found.iterations;
    return result;
}
