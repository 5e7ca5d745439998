// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 12: the bytes of a pixel, as Image::store() computes them. For kernels that write bytes only.
// Define MM_TRUNCATED(x), the language's truncation to int, before including it.

// Converts a colour component, 0 to 1; NaN becomes 0.
FN int byte_of(scalar c) { return c > 0 ? MM_TRUNCATED(255 * (c < 1 ? c : 1)) : 0; }
