// SPDX-License-Identifier: Apache-2.0
// The 64-bit hash FNV-1a (Fowler, Noll and Vo).
#pragma once

#include <cstddef>
#include <cstdint>

namespace mandelmarch {

inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325;

// Returns the hash of the bytes. If `hash` is the hash of earlier bytes, returns the hash of the earlier bytes followed
// by these.
inline std::uint64_t fnv1a(const void* data, std::size_t size, std::uint64_t hash = fnv1a_start)
{
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3;
    return hash;
}

}  // namespace mandelmarch
