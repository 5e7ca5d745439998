// SPDX-License-Identifier: Apache-2.0
// Kernel text, part 12: a pixel's bytes, as Image::store() makes them of its values. For kernels that hand out bytes
// alone. Whoever includes it says how its language cuts a number to an int: MM_TRUNCATED(x).

// Of a colour's part, 0 to 1. What is not a number becomes 0.
FN int byte_of(scalar c) { return c > 0 ? MM_TRUNCATED(255 * (c < 1 ? c : 1)) : 0; }
