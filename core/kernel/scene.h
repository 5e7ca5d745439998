// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 1: what a kernel is told about the picture, and what it hands back.

// Everything that is the same for every pixel. core/render/kernel_scene.cpp fills it, once, in double, then rounds.
// Ints, then reals, then triples: this order has the same layout in C++, in OpenCL C and in GLSL's std430.
struct Scene {
    int width;           // pixels
    int height;          // pixels
    int max_iterations;  // n of the distance estimator, 1 and more
    int max_steps;       // samples on a ray
    int fractal_whole;   // the fractal's own whole number, named in its file
    int colouring;       // as in the parameter file: 0 and 1 in shade.h, from 2 up in looks.h
    int canonical;    // 1: a hit is the root of DE(t) = tolerance * t; 0: it is the last sample of the plain schedule
    int differences;  // where normals come from: 0 the analytic gradient, 1 central differences, 2 a tetrahedron's

    scalar tolerance;  // 10^D: a surface is hit where DE < tolerance * t
    scalar stride;     // the share of the distance estimate that one step goes
    scalar end;        // no sample lies beyond this t
    scalar miss;       // depth of a pixel that hits nothing: +infinity
    scalar brightness;
    scalar difference_step;  // of the central differences, relative to max(|p|, 1)
    scalar hull;             // radius or half an edge of what holds the surface; 0: nothing is known
    scalar relaxation;       // how far steps go over the estimate: relaxed(); not above stride: not at all
    scalar root_share;       // a canonical hit is where |DE - tolerance t| is below this share of the tolerance
    scalar longitude;    // radians from forward to the picture's middle, round upward; equirectangular pictures only
    scalar longitudes;   // from there to its right edge; 0: the picture is a perspective one
    scalar latitude;     // radians from forward to the picture's middle, towards upward
    scalar latitudes;    // from there to its top edge
    scalar fractal[11];  // the fractal's own constants, named in its file

    triple eye;      // camera
    triple forward;  // towards the middle of the picture's pixels; of length 1 or little more; equirectangular: exactly
                     // ahead
    triple across;   // from the picture's middle to its right edge, at distance 1; equirectangular: as long as that arc
    triple upward;   // from the picture's middle to its top edge, at distance 1
    triple sun;      // a unit vector towards it, for looks
};

// A ray on its way. It can be stored after any step and taken up again by another pass.
struct Ray {
    vec3 direction;        // unit vector
    real end;              // no sample lies beyond this t
    real t;                // where the next sample will be taken
    real last_t;           // where the last sample was taken
    real last_distance;    // the distance estimate there
    real before_t;         // where the sample before the last one was taken
    real before_distance;  // the distance estimate there
    whole steps;           // samples taken while marching
    effort estimates;      // calls of the distance estimator, those of refining and of the normal included
    effort iterations;     // iterations in all those calls
};

// A ray that marches no more, and where it has hit. f(t) = DE(t) - tolerance t; only canonical pictures ask for it. It
// can be stored after any try and taken up again by another pass.
struct Hit {
    vec3 direction;     // unit vector
    real state;         // one of refine.h's
    real t;             // canonical: the last root that was tried, at first the last sample; else t after the last step
    real below_t;       // the last sample; canonical: the bracket's far end, where f < 0
    real below_f;       // f there, or the share of it that the method takes
    real above_t;       // the sample before the last one; canonical: the bracket's near end, where f > 0
    real above_f;       // as below_f
    whole steps;        // as a Ray's
    effort estimates;   // as a Ray's
    effort iterations;  // as a Ray's
};

// A pixel, finished.
struct Pixel {
    vec3 colour;  // 0 to 1, as displayed
    real depth;   // t of the hit
    whole steps;
    effort estimates;
    effort iterations;
};

// What a distance estimator returns: a lower bound of the distance to the surface, and what it cost.
struct Estimate {
    real distance;
    effort iterations;
};
