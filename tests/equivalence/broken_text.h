// The Mandelbox's text, whole or with a defect, one pixel at a time. Plain data: contracted.cpp is compiled for another
// instruction set.
#pragma once

namespace mandelmarch::broken {

struct Values {
    double red, green, blue, depth;
};

// `scene` is the text's Scene in the precision's layout.
using Text = void(const void* scene, bool is_float, int i, int j, Values& to);
Text whole, wrong_fold, contracted;

}  // namespace mandelmarch::broken
