// SPDX-License-Identifier: Apache-2.0
// Profile: renders tiles as pool.h does, and times each stage. Shades hits in three separate passes (normals,
// colours, output), so that each can be timed.

constexpr int most_packs = pool_rays / pack_lanes + 2;

// Memory of a thread for a profile.
struct ProfileMemory {
    Pools pools;
    Normal normals[most_packs];
    Pixel pixels[most_packs];
};

// Returns a pack of finished hits. The lanes after the pool's last hit are marked as misses.
HWY_INLINE Hit finished(const Drawing& d, int pack)
{
    const Pool& ended = d.pools.ended;
    Hit hit = load<HitPack, arrived>(ended, pack * pack_lanes).hit;
    hit.state = pick(first_lanes(ended.size - pack * pack_lanes), hit.state, no_hit());
    return hit;
}

// The three passes of shading. They need not be inlined, because one call handles thousands of rays.
HWY_NOINLINE HWY_MAYBE_UNUSED void take_normals(const Drawing& d, int packs, Normal* normals)
{
    for (int k = 0; k < packs; ++k) {
        const Hit hit = finished(d, k);
        const ShadingPoint at = shading_point(d.scene, hit);
        normals[k] = normal_at(d.scene, at.p, at.t, is_hit(hit));
    }
}

HWY_NOINLINE HWY_MAYBE_UNUSED void shade_packs(const Drawing& d, int packs, const Normal* normals, Pixel* pixels)
{
    for (int k = 0; k < packs; ++k) {
        const Hit hit = finished(d, k);
        pixels[k] = shade_with(d.scene, hit, missed(d.scene, hit), shading_point(d.scene, hit), normals[k]);
    }
}

HWY_NOINLINE HWY_MAYBE_UNUSED void store_packs(Drawing& d, int packs, const Pixel* pixels)
{
    const Pool& ended = d.pools.ended;
    for (int k = 0; k < packs; ++k) {
        const whole places = load<HitPack, arrived>(ended, k * pack_lanes).pixel;
        store_pixels(pixels[k], places, first_lanes(ended.size - k * pack_lanes), d.canvas, d.spent);
    }
}

// Clock that times the passes. When the pool of ended rays is a quarter full, the clock shades these rays in the three
// passes, so that other passes rarely have to shade.
class StageClock {
public:
    StageClock(ProfileMemory& memory, double (*now)(), double* seconds)
        : memory_(memory), now_(now), seconds_(seconds), last_(now())
    {
    }

    void after(Drawing& d, Stage stage)
    {
        took(stage);
        if (d.pools.ended.size > pool_rays / 4) shade(d, d.pools.ended.size / pack_lanes);
    }

    void finish(Drawing& d) { shade(d, (d.pools.ended.size + pack_lanes - 1) / pack_lanes); }

private:
    void took(Stage stage)
    {
        const double here = now_();
        seconds_[static_cast<int>(stage)] += here - last_;
        last_ = here;
    }

    void shade(Drawing& d, int packs)
    {
        take_normals(d, packs, memory_.normals);
        took(Stage::normal);
        shade_packs(d, packs, memory_.normals, memory_.pixels);
        took(Stage::shade);
        store_packs(d, packs, memory_.pixels);
        keep_rest<arrived>(d.pools.ended, packs * pack_lanes);
        took(Stage::output);
    }

    ProfileMemory& memory_;
    double (*now_)();
    double* seconds_;
    double last_;
};

// Renders tiles until none are left, and adds the seconds of each Stage to `seconds`. `at`: address of a ProfileMemory.
// The given Shading is used only when another pass must make room in the pool of ended rays.
template <const Sampling& sampling, const Shading& shading>
void profile(const KernelScene<MM_REAL>& scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* at,
             double (*clock)(), double* seconds)
{
    ProfileMemory& memory = *static_cast<ProfileMemory*>(at);
    Drawing d = drawing(scene_as<Scene>(scene), canvas, tiles, memory.pools, sampling, shading);
    draw_with(d, StageClock(memory, clock, seconds));
}
