// SPDX-License-Identifier: Apache-2.0
// Writes finished pixels from packs to the canvas.

// Stores the values of the active lanes, without gaps.
HWY_INLINE void store_compact(const whole& from, const mask& on, Int* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Wholes(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

HWY_INLINE void store_compact(const real& from, const mask& on, MM_REAL* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Reals(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

// Returns trunc(255 c), with c clamped to [0, 1]; 0 for NaN.
HWY_INLINE whole byte_of(const real& c)
{
    const real scaled = 255 * smaller(larger(c, 0), 1);
    whole a;
    EACH_REGISTER(a.of[u] = hn::ConvertTo(Wholes(), scaled.of[u]);)
    return a;
}

// Returns a pixel's three bytes in one integer, with red in the lowest byte.
HWY_INLINE whole bytes_of(const vec3& colour)
{
    const whole red = byte_of(colour.x);
    const whole green = byte_of(colour.y);
    const whole blue = byte_of(colour.z);
    whole a;
    EACH_REGISTER(a.of[u] = hn::Or(red.of[u], hn::Or(hn::ShiftLeft<8>(green.of[u]), hn::ShiftLeft<16>(blue.of[u])));)
    return a;
}

constexpr int places_room = pack_lanes + register_lanes;  // padded, because whole registers are written

#if MM_COUNTED
HWY_INLINE std::uint64_t sum_of(const whole& a, const mask& on)
{
    std::uint64_t sum = 0;
    EACH_REGISTER(Int counted[register_lanes];
                  hn::StoreU(hn::IfThenElseZero(hn::RebindMask(Wholes(), on.of[u]), a.of[u]), Wholes(), counted);
                  for (const Int count
                       : counted) sum += static_cast<std::uint64_t>(count);)
    return sum;
}

HWY_INLINE void count_work(const Pixel& pixel, const mask& on, WorkCounts& spent)
{
    spent.steps += sum_of(pixel.steps, on);
    spent.de_calls += sum_of(pixel.de_calls, on);
    spent.iterations += sum_of(pixel.iterations, on);
}

// Stores the active lanes' pixels at their indices in the planes.
HWY_NOINLINE void store_values(const Pixel& pixel, const whole& places, const mask& on, const Canvas<MM_REAL>& canvas)
{
    const int lanes = lanes_on(on);
    Int at[places_room] = {};
    MM_REAL values[real_planes][places_room] = {};
    Int work[whole_planes][places_room] = {};
    store_compact(places, on, at);
    store_compact(pixel.colour.x, on, values[0]);
    store_compact(pixel.colour.y, on, values[1]);
    store_compact(pixel.colour.z, on, values[2]);
    store_compact(pixel.depth, on, values[3]);
    store_compact(pixel.steps, on, work[0]);
    store_compact(pixel.de_calls, on, work[1]);
    store_compact(pixel.iterations, on, work[2]);
    for (int i = 0; i < lanes; ++i) {
        for (int plane = 0; plane < real_planes; ++plane)
            canvas.reals[plane * canvas.pixels + at[i]] = values[plane][i];
        for (int plane = 0; plane < whole_planes; ++plane) {
            canvas.wholes[plane * canvas.pixels + at[i]] = static_cast<int>(work[plane][i]);
        }
    }
}
#endif

// Stores the bytes of the active lanes' pixels, for one register.
HWY_INLINE void store_bytes(hn::Vec<Wholes> colours, hn::Vec<Wholes> places, hn::Mask<Reals> on, unsigned char* canvas)
{
    Int at[register_lanes];
    Int bytes[register_lanes];
    hn::StoreU(compressed(places, on), Wholes(), at);
    hn::StoreU(compressed(colours, on), Wholes(), bytes);
    const int lanes = static_cast<int>(hn::CountTrue(Reals(), on));
    for (int i = 0; i < lanes; ++i) {
        unsigned char* to = canvas + 3 * static_cast<std::ptrdiff_t>(at[i]);
        // Stores red and green together; requires a little-endian machine.
        const auto low = static_cast<std::uint16_t>(bytes[i]);
        __builtin_memcpy(to, &low, sizeof(low));
        to[2] = static_cast<unsigned char>(bytes[i] >> 16);
    }
}

// Stores finished pixels on the canvas. Packs that do not count work (MM_COUNTED 0) can store only bytes.
HWY_NOINLINE void store_pixels(const Pixel& pixel, whole places, mask on, const Canvas<MM_REAL>& canvas,
                               WorkCounts& spent)
{
    if (canvas.bytes != nullptr) {
        const whole colours = bytes_of(pixel.colour);
        EACH_REGISTER(store_bytes(colours.of[u], places.of[u], on.of[u], canvas.bytes);)
    }
#if MM_COUNTED
    count_work(pixel, on, spent);
    if (canvas.bytes == nullptr) store_values(pixel, places, on, canvas);
#else
    static_cast<void>(spent);
#endif
}
