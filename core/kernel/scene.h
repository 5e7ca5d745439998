// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 1: the data passed to a kernel and the results it returns.

// Everything that is the same for all pixels. Computed in double by core/render/kernel_scene.cpp, then rounded. Ints,
// then reals, then triples: this order has the same layout in C++, in OpenCL C and in GLSL's std430.
struct Scene {
    int width;           // pixels
    int height;          // pixels
    int max_iterations;  // n of the distance estimator, at least 1
    int max_steps;       // max samples of a ray
    int fractal_whole;   // the fractal's own integer, named in its file
    int colouring;       // as in the parameter file: 0 and 1 in shade.h, from 2 up in looks.h
    int canonical;       // 1: a hit is the root of DE(t) = tolerance * t; 0: the last sample of the original stepping
    int differences;  // source of normals: 0 analytic gradient, 1 central differences, 2 differences over a tetrahedron

    scalar tolerance;  // 10^D: a surface is hit where DE < tolerance * t
    scalar step_factor;     // step factor: length of a step, in distance estimates
    scalar end;        // largest t of a sample
    scalar miss;       // depth of a pixel without a hit: +infinity
    scalar brightness;
    scalar difference_step;  // of the central differences, relative to max(|p|, 1)
    scalar hull;             // radius, or half the edge, of the bounding volume of the surface; 0: unknown
    scalar relaxation;       // over-relaxation factor, see relaxed(); up to the step factor: none
    scalar root_share;       // a canonical hit has |DE - tolerance t| below this fraction of the tolerance
    scalar longitude;    // radians from forward to the picture's centre, around upward; equirectangular pictures only
    scalar longitudes;   // radians from the centre to the right edge; 0: perspective picture
    scalar latitude;     // radians from forward to the picture's centre, towards upward
    scalar latitudes;    // radians from the centre to the top edge
    scalar fractal[11];  // the fractal's own constants, named in its file

    triple eye;      // camera
    triple forward;  // towards the centre of the pixels; length 1 or slightly more; equirectangular: exactly ahead
    triple across;   // from the centre to the right edge, at distance 1; equirectangular: length of that arc
    triple upward;   // from the centre to the top edge, at distance 1
    triple sun;      // unit vector towards the sun, for looks
};

// A marching ray. It can be stored after any step and continued by another pass.
struct Ray {
    vec3 direction;        // unit vector
    real end;              // largest t of a sample
    real t;                // next sample
    real last_t;           // last sample
    real last_distance;    // distance estimate at the last sample
    real before_t;         // sample before the last one
    real before_distance;  // distance estimate there
    whole steps;           // marching samples
    counter de_calls;      // DE evaluations, including those of refinement and normal
    counter iterations;     // iterations of all DE evaluations
};

// A ray that has stopped, and its hit. Canonical pictures use f(t) = DE(t) - tolerance t. A Hit can be stored after any
// refinement and continued by another pass.
struct Hit {
    vec3 direction;     // unit vector
    real state;         // a state defined in refine.h
    real t;             // canonical: the last refinement, at first the last sample; otherwise t after the last step
    real below_t;       // the last sample; canonical: far end of the bracket, with f < 0
    real below_f;       // f at below_t, possibly scaled down by narrowed()
    real above_t;       // the sample before the last one; canonical: near end of the bracket, with f > 0
    real above_f;       // f at above_t, likewise
    whole steps;        // as in Ray
    counter de_calls;   // as in Ray
    counter iterations;  // as in Ray
};

// A finished pixel.
struct Pixel {
    vec3 colour;  // 0 to 1, as displayed
    real depth;   // t of the hit
    whole steps;
    counter de_calls;
    counter iterations;
};

// Result of a DE evaluation: a lower bound of the distance to the surface, and the iterations used.
struct Estimate {
    real distance;
    counter iterations;
};
