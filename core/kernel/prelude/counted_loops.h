// SPDX-License-Identifier: Apache-2.0
// Counts loop iterations. Include it after a C++ prelude. Every iteration adds 1 to MM_LOOPS, an expression for the
// counter, and the end of a loop adds one more. undefine.h ends the counting.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
// clang-format off
#define while(...) while (++MM_LOOPS, (__VA_ARGS__))
// clang-format on
