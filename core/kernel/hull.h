// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 4: hulls. A hull is a bounding volume that contains the surface of a fractal. It is a sphere or a
// cube around the origin.

// The part of a ray inside a hull, from t = first to t = last; last < first if the ray misses the hull.
struct Span {
    real first;
    real last;
};

FN Span sphere_span(scalar radius, vec3 origin, vec3 direction)
{
    real middle = -dot3(origin, direction);
    vec3 nearest_point = along(origin, direction, middle);
    real rest = radius * radius - dot3(nearest_point, nearest_point);
    real half_length = quick_root(larger(rest, BY_PRECISION(1.0e-290, 1.0e-30)));
    Span span;
    span.first = pick(rest > 0, middle - half_length, R(1.0));
    span.last = pick(rest > 0, middle + half_length, R(-1.0));
    return span;
}

// Returns the part of a ray between two parallel planes. `origin` and `direction` are the ray's components
// perpendicular to the planes, which lie at -size and size.
FN Span slab_span(scalar size, real origin, real direction)
{
    // Replaces a direction of nearly 0, to avoid a division by 0. This does not change the picture.
    real slope = pick(magnitude(direction) > R(1.0e-12), direction, R(1.0e-12));
    real a = quick_quotient(-size - origin, slope);
    real b = quick_quotient(size - origin, slope);
    Span span;
    span.first = smaller(a, b);
    span.last = larger(a, b);
    return span;
}

// Returns the part of a ray inside a cube. size: half the length of an edge.
FN Span cube_span(scalar size, vec3 origin, vec3 direction)
{
    Span x = slab_span(size, origin.x, direction.x);
    Span y = slab_span(size, origin.y, direction.y);
    Span z = slab_span(size, origin.z, direction.z);
    Span span;
    span.first = larger(larger(x.first, y.first), z.first);
    span.last = smaller(smaller(x.last, y.last), z.last);
    return span;
}
