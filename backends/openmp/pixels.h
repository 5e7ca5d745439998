// Finished pixels, from packs to the canvas. Included by samples.h, in its namespace; no guard.

// The lanes that are on, without gaps.
HWY_INLINE void store_compact(const whole& from, const mask& on, Int* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Wholes(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

HWY_INLINE void store_compact(const real& from, const mask& on, MM_REAL* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Reals(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

// trunc(255 c), c cut to [0, 1]; 0 where it is not a number.
HWY_INLINE whole byte_of(const real& c)
{
    const real scaled = 255 * smaller(larger(c, 0), 1);
    whole a;
    EACH_REGISTER(a.of[u] = hn::ConvertTo(Wholes(), scaled.of[u]);)
    return a;
}

// A pixel's three bytes in one number, red lowest.
HWY_INLINE whole bytes_of(const vec3& colour)
{
    const whole red = byte_of(colour.x);
    const whole green = byte_of(colour.y);
    const whole blue = byte_of(colour.z);
    whole a;
    EACH_REGISTER(a.of[u] = hn::Or(red.of[u], hn::Or(hn::ShiftLeft<8>(green.of[u]), hn::ShiftLeft<16>(blue.of[u])));)
    return a;
}

// Finished pixels to their places on the canvas.
HWY_NOINLINE void store_pixels(const Pixel& pixel, const whole& places, const mask& on, const Canvas<MM_REAL>& canvas,
                               Spent& spent)
{
    const int lanes = lanes_on(on);
    constexpr int room = pack_lanes + register_lanes;
    Int at[room];
    Int work[whole_planes][room];
    store_compact(places, on, at);
    store_compact(pixel.steps, on, work[0]);
    store_compact(pixel.estimates, on, work[1]);
    store_compact(pixel.iterations, on, work[2]);
    for (int i = 0; i < lanes; ++i) {
        spent.steps += static_cast<std::uint64_t>(work[0][i]);
        spent.estimates += static_cast<std::uint64_t>(work[1][i]);
        spent.iterations += static_cast<std::uint64_t>(work[2][i]);
    }
    if (canvas.bytes != nullptr) {
        Int bytes[room];
        store_compact(bytes_of(pixel.colour), on, bytes);
        for (int i = 0; i < lanes; ++i) {
            unsigned char* to = canvas.bytes + 3 * static_cast<std::ptrdiff_t>(at[i]);
            to[0] = static_cast<unsigned char>(bytes[i]);
            to[1] = static_cast<unsigned char>(bytes[i] >> 8);
            to[2] = static_cast<unsigned char>(bytes[i] >> 16);
        }
        return;
    }
    MM_REAL values[real_planes][room];
    store_compact(pixel.colour.x, on, values[0]);
    store_compact(pixel.colour.y, on, values[1]);
    store_compact(pixel.colour.z, on, values[2]);
    store_compact(pixel.depth, on, values[3]);
    for (int i = 0; i < lanes; ++i) {
        for (int plane = 0; plane < real_planes; ++plane)
            canvas.reals[plane * canvas.pixels + at[i]] = values[plane][i];
        for (int plane = 0; plane < whole_planes; ++plane) {
            canvas.wholes[plane * canvas.pixels + at[i]] = static_cast<int>(work[plane][i]);
        }
    }
}
