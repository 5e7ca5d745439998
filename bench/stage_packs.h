// The body of every stages_*.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::bench {
namespace HWY_NAMESPACE {
namespace {

#define MM_REGISTERS 2
#include "backends/openmp/pack_tile.h"
#undef MM_REGISTERS

// A pack between two stages.
struct Stored {
    Ray ray;
    vec3 normal;
    Pixel pixel;
};
constexpr int packs_across = tile_side / pack_width;
constexpr int packs_in_tile = packs_across * (tile_side / pack_height);

HWY_INLINE Ray begun(const Scene& scene, int left, int bottom)
{
    MM_REAL i[pack_lanes];
    MM_REAL j[pack_lanes];
    for (int lane = 0; lane < pack_lanes; ++lane) {
        const int x = left + lane % pack_width;
        const int y = bottom + lane / pack_width;
        i[lane] = static_cast<MM_REAL>(x < scene.width ? x : scene.width - 1);
        j[lane] = static_cast<MM_REAL>(y < scene.height ? y : scene.height - 1);
    }
    return begin(scene, load_lanes(i), load_lanes(j));
}

HWY_INLINE vec3 normal_of(const Scene& scene, const Ray& ray)
{
    const mask hit = has_hit(scene, ray);
    if (!any(hit)) return ray.direction;
    const vec3 p = along(point_at(scene, ray, ray.last_t), ray.direction, -tolerance(scene, ray));
    return normal_at(scene, p, hit).direction;
}

// What shade() does beside the normal.
HWY_INLINE Pixel shaded(const Scene& scene, const Stored& pack)
{
    const mask hit = has_hit(scene, pack.ray);
    Pixel pixel;
    const real grey(static_cast<MM_REAL>(0.4));
    pixel.colour = pick3(hit, lit(scene, pack.ray.direction, pack.normal), {grey, grey, grey});
    pixel.depth = pick(hit, pack.ray.last_t, real(scene.miss));
    pixel.steps = pack.ray.steps;
    pixel.estimates = pack.ray.estimates;
    pixel.iterations = pack.ray.iterations;
    return pixel;
}

void run_stage(TimedStage stage, const void* data, int left, int bottom, void* stored, Tile<MM_REAL>& tile)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    Stored* packs = static_cast<Stored*>(stored);
    for (int at = 0; at < packs_in_tile; ++at) {
        const int x0 = at % packs_across * pack_width;
        const int y0 = at / packs_across * pack_height;
        if (left + x0 >= scene.width || bottom + y0 >= scene.height) continue;
        Stored& pack = packs[at];
        switch (stage) {
            case TimedStage::begin: pack.ray = begun(scene, left + x0, bottom + y0); break;
            case TimedStage::march: pack.ray = march(scene, pack.ray, scene.max_steps); break;
            case TimedStage::refine:
                if (scene.canonical != 0) pack.ray = refine(scene, pack.ray);
                break;
            case TimedStage::normal: pack.normal = normal_of(scene, pack.ray); break;
            case TimedStage::shade: pack.pixel = shaded(scene, pack); break;
            case TimedStage::output: store_pixels(pack.pixel, x0, y0, tile); break;
        }
    }
}

StageKernel<MM_REAL> kernel()
{
    return {hwy::TargetName(HWY_TARGET), pack_lanes, packs_in_tile * sizeof(Stored), run_stage, draw_tile};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mandelmarch::bench {

HWY_EXPORT(kernel);

StageKernel<MM_REAL> MM_STAGES();
StageKernel<MM_REAL> MM_STAGES() { return HWY_DYNAMIC_DISPATCH(kernel)(); }

}  // namespace mandelmarch::bench
#endif
