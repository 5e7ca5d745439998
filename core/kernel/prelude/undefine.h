// SPDX-License-Identifier: Apache-2.0
// Removes the macros of a C++ prelude, so that another prelude or other code can follow.
#undef FN
#undef FN_CALLED
#undef vec3
#undef pick
#undef any
#undef count
#undef R
#undef BY_PRECISION
#undef MM_HAS_LARGER
#undef MM_HAS_TALLY
#undef MM_HAS_INVERSE_ROOT
#undef MM_SCENE_BY_REFERENCE
#undef MM_HAS_CLIPPED
#undef MM_HAS_ROUGH
#undef MM_HAS_ROUGH_LOG
#undef MM_HAS_QUICK
#undef over_root
#undef MM_NEAREST
#undef EACH_REGISTER
#undef MM_IN_REGISTER
#undef while
