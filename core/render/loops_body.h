// SPDX-License-Identifier: Apache-2.0
// Counts the loop iterations of the kernel source that is included before this file in the same namespace. Has no
// include guard.

template <class Body>
std::int64_t counted(Body body)
{
    const std::int64_t before = loops();
    body();
    return loops() - before;
}

inline Loops loops_of_text(const void* data)
{
    static_assert(sizeof(Scene) == sizeof(layout_f64::Scene));
    const Scene& scene = *static_cast<const Scene*>(data);
    const Ray ray = begin(scene, 0, 0);
    Loops most{};
    most.pass = counted([&] { march(scene, ray, 0); });
    most.step = counted([&] { march(scene, ray, 1); }) - most.pass;
    const Hit hit = stopped(scene, ray);
    most.tried = counted([&] { refine_by(scene, hit, 1); }) - counted([&] { refine_by(scene, hit, 0); });
    most.refine = counted([&] { refine(scene, hit); });
    most.shade = counted([&] { shade(scene, hit); });
    return most;
}
