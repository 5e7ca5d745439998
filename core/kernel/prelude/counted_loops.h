// SPDX-License-Identifier: Apache-2.0
// Beside a C++ prelude: loops that count. Each round adds 1 to MM_LOOPS, an expression for the counter, and a loop's
// end adds one more. undefine.h takes it away again.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
// clang-format off
#define while(...) while (++MM_LOOPS, (__VA_ARGS__))
// clang-format on
