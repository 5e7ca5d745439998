// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 13: converts colours to bytes, as Image::store() does. For kernels that write bytes only. Before
// including it, define MM_TRUNCATED(x) as the language's truncation to int.

// Converts a colour component from 0 to 1 to a byte; NaN becomes 0.
FN int byte_of(scalar c) { return c > 0 ? MM_TRUNCATED(255 * (c < 1 ? c : 1)) : 0; }
