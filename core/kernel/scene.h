// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 1: the data that a kernel receives and the results that it returns.

// The data that are the same for all pixels. core/render/kernel_scene.cpp computes them in double and rounds them. In
// this order (ints, reals, triples) the layout is the same in C++, in OpenCL C and in GLSL's std430.
struct Scene {
    int width;           // pixels
    int height;          // pixels
    int max_iterations;  // n of the distance estimator, at least 1
    int max_steps;       // max number of samples of a ray
    int fractal_whole;   // an integer whose meaning the fractal's file defines
    int colouring;       // colouring type of the parameter file, for lit() in shade.h; looks do not depend on it
    int canonical;       // 1: a hit is the root of DE(t) = tolerance * t; 0: the last sample of the original stepping
    int differences;  // source of normals: 0 analytic gradient, 1 central differences, 2 differences over a tetrahedron

    scalar tolerance;    // 10^D of the parameter file: a sample is a hit if DE < tolerance * t
    scalar step_factor;  // length of a step as a multiple of the estimate
    scalar end;          // max t of a sample
    scalar miss;         // depth of a pixel without a hit: +infinity
    scalar brightness;
    scalar difference_step;  // half distance of the points of central differences, as a multiple of max(|p|, 1)
    scalar hull;             // size of the hull (hull.h): radius of the sphere, half the edge of the cube; 0: unknown
    scalar relaxation;       // over-relaxation factor, see relaxed(); not above step_factor: no over-relaxation
    scalar root_share;       // refinement ends if |DE - tolerance t| is below this fraction of the tolerance
    scalar longitude;     // radians from forward to the picture's centre, around upward; equirectangular pictures only
    scalar longitudes;    // radians from the centre to the right edge; 0: perspective picture
    scalar latitude;      // radians from forward to the picture's centre, towards upward
    scalar latitudes;     // radians from the centre to the top edge
    scalar spacing;       // max distance of diagonally adjacent rays, at distance 1 from the camera
    scalar subtile_hull;  // size of an enlarged hull, which a subtile's centre meets if one of its rays meets the hull
    scalar fractal[13];   // constants whose meanings the fractal's file defines
    scalar look[68];      // numbers of the look, whose meanings looks.h defines; 0: the colouring is not a look

    triple eye;      // position of the camera
    triple forward;  // to the centre of the pixels, at distance 1; equirectangular: unit vector of the view direction
    triple across;   // from the centre to the right edge, at distance 1; equirectangular: length of that arc
    triple upward;   // from the centre to the top edge, at distance 1; equirectangular: length of that arc
    triple sun;      // unit vector towards the sun, used by looks
    // Axes of the sky, unit vectors, used by looks. The horizon is at right angles to sky_up.
    triple sky_west;
    triple sky_up;
    triple sky_north;
    triple grain;  // the noise of skies, see grained() in looks.h; 0: none
};

// A ray that is being marched. It can be stored after any step, and another pass can continue it.
struct Ray {
    vec3 direction;        // unit vector
    real end;              // max t of a sample
    real t;                // t of the next sample
    real last_t;           // t of the last sample
    real last_distance;    // estimate at the last sample
    real before_t;         // t of the sample before the last one
    real before_distance;  // estimate at that sample
    whole steps;           // number of samples taken by marching
    counter de_calls;      // number of DE evaluations, including those of refinement and normals
    counter iterations;    // number of iterations of these DE evaluations
};

// A ray that has stopped, and its hit if it has one. In canonical pictures, f(t) = DE(t) - tolerance t. A Hit can be
// stored after any refinement, and another pass can continue it.
struct Hit {
    vec3 direction;      // unit vector
    real state;          // one of the states in refine.h
    real t;              // canonical: t of the last refinement, or of the last sample; otherwise t after the last step
    real below_t;        // t of the last sample; canonical: the far end of the bracket, where f < 0
    real below_f;        // f at below_t, possibly scaled down by narrowed()
    real above_t;        // t of the sample before the last one; canonical: the near end of the bracket, where f >= 0
    real above_f;        // f at above_t, possibly scaled down by narrowed()
    whole steps;         // as in Ray
    counter de_calls;    // as in Ray
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

// The result of a DE evaluation: the estimate of the distance to the surface, and the number of iterations used.
struct Estimate {
    real distance;
    counter iterations;
};
