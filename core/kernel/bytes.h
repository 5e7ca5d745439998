// SPDX-License-Identifier: Apache-2.0
// Kernel source, part 13: converts colours to bytes, as Image::store() does. For kernels that write bytes only. Before
// including it, define MM_TRUNCATED(x) as the language's truncation to int.

// Converts a colour component from 0 to 1 to a byte; NaN becomes 0.
FN whole byte_of(real c) { return MM_TRUNCATED(pick(c > 0, 255 * pick(c < 1, c, 1), 0)); }

// Returns the bytes of a colour as one number, with red in the lowest byte.
FN whole bytes_of(vec3 colour) { return byte_of(colour.x) | byte_of(colour.y) << 8 | byte_of(colour.z) << 16; }
