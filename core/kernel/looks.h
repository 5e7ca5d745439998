// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 11: looks. The numbers of a look are in scene.look, in the order of look_entries in
// core/scene/look.h. Colours are linear light until displayed() converts them.
// All looks have haze, ambient occlusion and a soft key light. The occlusion and the softness are computed from
// estimates at a few points along a line (Evans, "Fast approximations for global illumination on dynamic scenes",
// SIGGRAPH 2006 course).

FN vec3 look_colour(Scene scene, int first)
{
    return vec3(scene.look[first], scene.look[first + 1], scene.look[first + 2]);
}

FN vec3 surface_colour(Scene scene) { return look_colour(scene, 0); }
FN vec3 sun_light(Scene scene) { return look_colour(scene, 35); }
FN vec3 sky_light(Scene scene) { return look_colour(scene, 38); }
FN vec3 ground_light(Scene scene) { return look_colour(scene, 41); }
FN vec3 camera_light(Scene scene) { return look_colour(scene, 44); }
FN vec3 lamp(Scene scene) { return look_colour(scene, 47); }
FN vec3 fill_light(Scene scene) { return look_colour(scene, 50); }
FN vec3 zenith(Scene scene) { return look_colour(scene, 53); }
FN vec3 horizon(Scene scene) { return look_colour(scene, 56); }
FN vec3 glow(Scene scene) { return look_colour(scene, 59); }
FN scalar wide_halo(Scene scene) { return scene.look[62]; }
FN scalar narrow_halo(Scene scene) { return scene.look[63]; }
FN scalar horizon_glow(Scene scene) { return scene.look[64]; }
FN scalar cloud_cover(Scene scene) { return scene.look[65]; }
FN scalar haze_share(Scene scene) { return scene.look[66]; }
FN scalar exposure(Scene scene) { return scene.look[67]; }

// Returns 1 if the picture has a look, whose exposure is positive, and 0 if it has another colouring.
FN int has_look(Scene scene)
{
    if (exposure(scene) > 0) return 1;
    return 0;
}

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

// Returns the colour with a layer of the palette over it. `first`: the place of the layer's numbers. The orbit trap
// selects how much of the layer is seen.
FN vec3 layered(Scene scene, vec3 colour, vec3 trap, int first)
{
    real seen = saturated(dot3(trap, look_colour(scene, first + 3)) + scene.look[first + 6]);
    return blend(colour, look_colour(scene, first), scene.look[first + 7] * seen);
}

// Returns the albedo of the surface: the palette's colours, mixed by the orbit trap.
FN vec3 albedo(Scene scene, vec3 trap)
{
    vec3 colour = layered(scene, surface_colour(scene), trap, 3);
    colour = layered(scene, colour, trap, 11);
    colour = layered(scene, colour, trap, 19);
    return layered(scene, colour, trap, 27);
}

// Returns the colour of the sky without clouds. It is also the colour of the haze in that direction.
FN vec3 sky(Scene scene, vec3 direction)
{
    // The sky is brighter at the horizon and darker above and below. The sun has a wide and a narrow halo, and the
    // horizon can glow, most below the sun.
    real rise = dot3(direction, splat(scene.sky_up));
    real low = 1 - rise * rise;
    low = low * low;
    low = low * low;
    real towards_sun = dot3(direction, splat(scene.sun));
    real near = saturated(towards_sun);
    near = near * near;
    real wide = near * near;
    real narrow = wide * wide;
    narrow = narrow * narrow;
    narrow = narrow * narrow;
    real band = low * low;
    band = band * band * (R(0.6) + R(0.4) * towards_sun);
    real glowing = wide_halo(scene) * wide + narrow_halo(scene) * narrow + horizon_glow(scene) * band;
    return along(blend(zenith(scene), horizon(scene), low), glow(scene), glowing);
}

// Returns a smooth wave of period 1, from 0 to 1.
FN real wave(real x)
{
    real r = x - nearest(x);
    r = 1 - 4 * r * r;
    return r * r;
}

// Returns the opacity of the clouds in a direction. The clouds are a layer high above the ground, a sum of six octaves.
// An octave is a product of two waves at right angles; each wave is bent by the other and by the sum so far.
FN real clouds(Scene scene, vec3 direction)
{
    real height = larger(dot3(direction, splat(scene.sky_up)), 0);
    real u = quotient(dot3(direction, splat(scene.sky_west)), height + R(0.15)) + 3;
    real v = quotient(dot3(direction, splat(scene.sky_north)), height + R(0.15)) + 5;
    // Turned into the wind, and drawn out along it.
    real x = R(0.19) * (R(0.8) * u + R(0.6) * v);
    real y = R(0.55) * (R(0.8) * v - R(0.6) * u);
    real sum = 0;
    scalar weight = R(0.5);
    int octave = 0;
    while (octave < 6) {
        real across = wave(x + R(0.45) * wave(y + R(0.3)) + R(0.2) * sum);
        real upward = wave(y + R(0.45) * wave(R(0.7) * x) + R(0.15) * sum);
        sum = sum + weight * across * upward;
        real turned = R(2.07) * (R(0.8) * x + R(0.6) * y) + R(0.37);
        y = R(1.93) * (R(0.8) * y - R(0.6) * x) + R(0.71);
        x = turned;
        weight = weight * R(0.62);
        octave = octave + 1;
    }
    // Half of the sums are above 0.27. Clouds fade towards the horizon.
    real dense = saturated(R(2.2) * (sum - R(0.62) + R(0.45) * cloud_cover(scene))) * saturated(5 * height);
    return R(0.7) * dense * dense * (3 - 2 * dense);
}

// Returns the colour of a ray without a hit.
FN vec3 backdrop(Scene scene, vec3 direction)
{
    vec3 colour = sky(scene, direction);
    if (cloud_cover(scene) > 0) {
        real near = saturated(dot3(direction, splat(scene.sun)));
        near = near * near;
        vec3 light = along(horizon(scene), glow(scene), R(0.25) + R(0.6) * near * near);
        colour = blend(colour, light, clouds(scene, direction));
    }
    return colour;
}

// Converts linear light to a display value: applies the brightness, a film curve (Narkowicz, "ACES filmic tone mapping
// curve", 2016), and a gamma of 2.
FN real displayed(Scene scene, real light)
{
    real x = exposure(scene) * scene.brightness * light;
    return root(saturated(quotient(x * (R(2.51) * x + R(0.03)), x * (R(2.43) * x + R(0.59)) + R(0.14))));
}

// Returns a displayed colour with a noise of half of 1/255, which hides the steps between bytes in a smooth sky. It
// depends on the direction only (Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH 2014 course).
FN vec3 grained(Scene scene, vec3 colour, vec3 direction)
{
    real place = dot3(direction, splat(scene.grain));
    real noise = R(52.9829189) * (place - nearest(place));
    return along(colour, vec3(1, 1, 1), R(0.00392156862745098) * (noise - nearest(noise)));
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

// The light at a hit, and the air in front of it.
struct Lighting {
    vec3 light;   // from all directions, in front of the surface
    real glint;   // weight of the sun's reflection
    vec3 behind;  // colour of the haze
    real air;     // share of the haze
};

// Returns the light at a hit with the unit normal n and the openness `found`.
FN Lighting lighting(Scene scene, vec3 direction, vec3 n, real t, Occlusion found)
{
    vec3 sun = splat(scene.sun);
    real facing = saturated(-dot3(n, direction));
    real key = saturated(R(0.08) + R(0.92) * dot3(n, sun)) * found.sunwards;
    real shelter = found.along_normal * (R(0.35) + R(0.65) * found.along_normal);
    Lighting at;
    // Adds light from the sky, the ground and the sun, and a little from the camera.
    real rise = dot3(n, splat(scene.sky_up));
    at.light = times(shelter * (R(0.55) + R(0.45) * rise), sky_light(scene));
    at.light = along(at.light, ground_light(scene), shelter * (R(0.5) - R(0.5) * rise));
    at.light = along(at.light, sun_light(scene), key);
    at.light = along(at.light, camera_light(scene), shelter * facing);
    // Adds a lamp at the camera: its light decreases with the distance, and surfaces at grazing angles stay dark.
    real hazed = quotient(t, t + MM_SIZE);
    real fall = quotient(1 - hazed, 1 + 5 * hazed);
    at.light = along(at.light, lamp(scene), shelter * (R(0.15) + facing * facing) * fall);
    at.light = along(at.light, fill_light(scene), shelter);
    // The glint is where the normal is close to the direction halfway between the sun and the camera.
    real glint = saturated(dot3(n, unit(minus(sun, direction))));
    glint = glint * glint;
    glint = glint * glint;
    at.glint = glint * glint * glint * key;
    // The haze reaches half its maximum at about half the fractal's size, so that it also shows depth inside the
    // fractal.
    real air = quotient(5 * hazed, 1 + 4 * hazed);
    at.air = air * air * haze_share(scene);
    at.behind = sky(scene, direction);
    return at;
}

// Returns the displayed colour of a hit from its light and its orbit trap.
FN vec3 look_shown(Scene scene, Lighting at, vec3 trap)
{
    vec3 lit_stone = scaled(albedo(scene, trap), at.light);
    lit_stone = along(lit_stone, vec3(R(0.25), R(0.22), R(0.18)), at.glint);
    return displayed3(scene, blend(lit_stone, at.behind, at.air));
}

// Returns the colour of a hit at p with the unit normal n and the openness `found`.
FN_CALLED Look look(Scene scene, vec3 direction, vec3 p, vec3 n, real t, Occlusion found, mask on)
{
    // The light is computed before the loop of the orbit trap, so that few registers are live during the loop.
    Lighting at = lighting(scene, direction, n, t, found);
    Look result;
    result.colour = look_shown(scene, at, orbit_trap(scene, p, on));
    // Counts the orbit trap as one more evaluation.
    result.de_calls = tally(found.de_calls, on);
    result.iterations = found.iterations;
    return result;
}
