// SPDX-License-Identifier: Apache-2.0
// Makes loops count, after a C++ prelude: every iteration adds 1 to MM_LOOPS, an expression for the counter, and the
// end of a loop adds one more. undefine.h removes this.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
// clang-format off
#define while(...) while (++MM_LOOPS, (__VA_ARGS__))
// clang-format on
