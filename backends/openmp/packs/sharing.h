// SPDX-License-Identifier: Apache-2.0
// Finds hits that can share the occlusion of adjacent pixels, which were rendered earlier and show the same surface.

// Conditions for sharing, selected by how much sharing changes pictures (docs/notes/experiments.md).
constexpr MM_REAL same_surface = MM_REAL(0.02);  // max relative difference of the depths of pixels on one surface
constexpr MM_REAL alike = MM_REAL(0.12);         // max difference of along_normal + sunwards among the neighbours
constexpr int fewest_alike = 2;                  // min number of neighbours, of four, on the pixel's surface

// The four pixels in even columns and rows that surround each lane's pixel. Some of the four can be the same.
struct Around {
    hn::Vec<Wholes> at[4];     // half their indices in a plane
    hn::Mask<Reals> there[4];  // lanes whose neighbour is inside the band

    HWY_INLINE Around(const Canvas<MM_REAL>& canvas, int width, const whole& pixel)
    {
        const auto set = [](int value) MM_INLINED { return hn::Set(Reals(), static_cast<MM_REAL>(value)); };
        const auto wide = set(width);
        const auto number = hn::ConvertTo(Reals(), pixel.of[0]);
        // The row is floor((index + 0.5) / width). A band has fewer than 2^22 pixels, so the added half pixel exceeds
        // the rounding error.
        const auto row = hn::Floor(hn::Div(hn::Add(number, hn::Set(Reals(), MM_REAL(0.5))), wide));
        const auto column = hn::Sub(number, hn::Mul(row, wide));
        const auto half = hn::Set(Reals(), MM_REAL(0.5));
        const auto left = hn::Floor(hn::Mul(column, half));
        const auto down = hn::Floor(hn::Mul(row, half));
        const auto right = hn::Sub(column, left);  // equals left, or left + 1
        const auto up = hn::Sub(row, down);
        const auto is_right = hn::Lt(hn::Add(right, right), wide);
        const auto is_above = hn::Lt(hn::Add(up, up), set(canvas.end_row - canvas.first_row));
        const auto below = hn::Mul(down, wide);
        const auto above = hn::Mul(up, wide);
        at[0] = hn::ConvertTo(Wholes(), hn::Add(below, left));
        at[1] = hn::ConvertTo(Wholes(), hn::Add(below, right));
        at[2] = hn::ConvertTo(Wholes(), hn::Add(above, left));
        at[3] = hn::ConvertTo(Wholes(), hn::Add(above, right));
        there[0] = hn::Eq(wide, wide);
        there[1] = is_right;
        there[2] = is_above;
        there[3] = hn::And(is_right, is_above);
    }
};

// Finds the active hits that can share occlusion, sets their shared occlusion to the mean of their neighbours', and
// returns the mask of these hits.
HWY_INLINE mask find_shared(const Drawing& d, HitPack& a, const mask& on)
{
    const auto gathered = [](const MM_REAL* from, hn::Vec<Wholes> at, hn::Mask<Reals> there) MM_INLINED {
        const auto safe = hn::IfThenElseZero(hn::RebindMask(Wholes(), there), at);
        return hn::IfThenElseZero(there, hn::GatherIndex(Reals(), from, safe));
    };
    const Around around(d.canvas, d.scene.width, a.pixel);
    const auto t = a.hit.below_t.of[0];
    const auto reach = hn::Mul(t, hn::Set(Reals(), same_surface));
    const auto none = hn::Zero(Reals());
    auto along_normal = none;
    auto sunwards = none;
    auto count = none;
    auto least = hn::Set(Reals(), MM_REAL(2));
    auto most = none;
    for (int k = 0; k < 4; ++k) {
        const auto there = hn::And(on.of[0], around.there[k]);
        const auto depth = gathered(d.canvas.neighbour_depth, around.at[k], there);
        const auto same = hn::And(there, hn::Lt(hn::Abs(hn::Sub(depth, t)), reach));
        const auto along_one = gathered(d.canvas.along_normal, around.at[k], same);
        const auto sunwards_one = gathered(d.canvas.sunwards, around.at[k], same);
        const auto both = hn::Add(along_one, sunwards_one);
        along_normal = hn::Add(along_normal, along_one);
        sunwards = hn::Add(sunwards, sunwards_one);
        count = hn::Add(count, hn::IfThenElseZero(same, hn::Set(Reals(), MM_REAL(1))));
        least = hn::IfThenElse(same, hn::Min(least, both), least);
        most = hn::IfThenElse(same, hn::Max(most, both), most);
    }
    a.shared.along_normal.of[0] = hn::Div(along_normal, count);
    a.shared.sunwards.of[0] = hn::Div(sunwards, count);
    mask shared;
    shared.of[0] = hn::And(on.of[0], hn::And(hn::Ge(count, hn::Set(Reals(), static_cast<MM_REAL>(fewest_alike))),
                                             hn::Le(hn::Sub(most, least), hn::Set(Reals(), alike))));
    return shared;
}

// Returns true if the hits of this lattice share occlusion. Only those of the last lattice do, whose neighbours are two
// pixels apart.
HWY_INLINE bool shares(const Drawing& d) { return d.canvas.sunwards != nullptr && d.canvas.lattice.before == 2; }
