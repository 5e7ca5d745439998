// Kernel text, part 5: a ray from the camera to its hit. begin -> march -> refine, the last two any number of times.

// The ray through pixel (i, j); j = 0 is the bottom row. u and v run from -1 to 1 over the picture.
FN Ray begin(Scene scene, real i, real j)
{
    real u = quotient(2 * i, scene.width) - 1;
    real v = quotient(2 * j, scene.height) - 1;
    Ray ray;
    ray.direction = unit(along(along(wide(scene.forward), wide(scene.across), u), wide(scene.upward), v));
    ray.t = 0;
    ray.last_t = 0;
    ray.last_distance = scene.end;  // larger than the tolerance at t = 0, so that the march begins
    ray.before_t = 0;
    ray.steps = 0;
    ray.estimates = 0;
    ray.iterations = 0;
    return ray;
}

FN real tolerance(Scene scene, Ray ray) { return ray.t * scene.tolerance; }

// True while the ray has neither hit nor left the scene.
FN mask marching(Scene scene, Ray ray)
{
    return ray.last_distance > tolerance(scene, ray) && ray.t <= scene.end && ray.steps < scene.max_steps;
}

FN mask has_hit(Scene scene, Ray ray) { return ray.last_distance < tolerance(scene, ray); }

FN vec3 point_at(Scene scene, Ray ray, real t) { return along(wide(scene.eye), ray.direction, t); }

// One step of sphere tracing (Hart, "Sphere tracing", The Visual Computer 12, 1996) for the rays that are on.
FN Ray advance(Scene scene, Ray ray, mask on)
{
    Estimate here = estimate(scene, point_at(scene, ray, ray.t), on);
    ray.before_t = pick(on, ray.last_t, ray.before_t);
    ray.last_t = pick(on, ray.t, ray.last_t);
    ray.last_distance = pick(on, here.distance, ray.last_distance);
    ray.t = pick(on, ray.t + scene.stride * here.distance, ray.t);
    ray.steps = ray.steps + count(on);
    ray.estimates = ray.estimates + count(on);
    ray.iterations = ray.iterations + here.iterations;
    return ray;
}

// At most `steps` steps of every ray that is still marching.
FN Ray march(Scene scene, Ray ray, int steps)
{
    mask on = marching(scene, ray);
    int i = 0;
    while (i < steps && any(on)) {
        ray = advance(scene, ray, on);
        on = marching(scene, ray);
        i = i + 1;
    }
    return ray;
}

// The canonical hit: the root of DE(t) = tolerance t between the last two samples, by bisection to a thousandth of the
// tolerance, or until no number is left between the two. A ray whose first sample was a hit stays where it is.
// At most `steps` halvings, after which it can go on in another pass.
FN Ray refine_by(Scene scene, Ray ray, int steps)
{
    real low = ray.before_t;  // DE > tolerance t
    real high = ray.last_t;   // DE < tolerance t
    mask on = has_hit(scene, ray) && ray.last_distance < scene.tolerance * high && high > low;
    ray.t = pick(on, high, ray.t);
    int i = 0;
    while (i < steps && any(on)) {
        real t = R(0.5) * (low + high);
        on = on && t > low && t < high && high - low > R(0.001) * scene.tolerance * high;
        Estimate here = estimate(scene, point_at(scene, ray, t), on);
        mask inside = on && here.distance < scene.tolerance * t;
        low = pick(on && !inside, t, low);
        high = pick(inside, t, high);
        ray.t = pick(inside, t, ray.t);
        ray.last_t = pick(inside, t, ray.last_t);
        ray.last_distance = pick(inside, here.distance, ray.last_distance);
        ray.estimates = ray.estimates + count(on);
        ray.iterations = ray.iterations + here.iterations;
        i = i + 1;
    }
    ray.before_t = low;
    return ray;
}

// 60 halvings leave no number between the two.
FN Ray refine(Scene scene, Ray ray) { return refine_by(scene, ray, 60); }
