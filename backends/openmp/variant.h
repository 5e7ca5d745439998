// A variant: the kernel text compiled for one fractal, precision, mode, instruction set and pack width. Plain data: it
// is shared with translation units that are compiled for one instruction set.
#pragma once

#include "core/image/tile.h"

namespace mandelmarch::openmp {

// Draws the tile whose bottom left pixel is (left, bottom) of the picture. `scene` is the kernel text's Scene in
// Real's layout. Of a tile that crosses the edge only the pixels inside are drawn.
template <class Real>
using DrawTile = void (*)(const void* scene, int left, int bottom, Tile<Real>& tile);

template <class Real>
struct Variant {
    const char* instruction_set;
    int pack;  // pixels at once
    DrawTile<Real> draw;
};

// Every variant of one fractal, precision and mode that this machine can run, the best last.
template <class Real>
struct VariantList {
    static constexpr int most = 8;
    Variant<Real> of[most];
    int count;
};

}  // namespace mandelmarch::openmp
