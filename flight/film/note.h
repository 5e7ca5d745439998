// SPDX-License-Identifier: Apache-2.0
// Notes beside finished files: FILE.made says what the file was made of and keeps a hash of its bytes, so that a file
// that is damaged, or of something else, is told from one that is finished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace mandelmarch {

// 32 hexadecimal digits that change when the bytes change: two FNV-1a hashes of 64 bits.
class Digest {
public:
    void add(const void* data, std::size_t size);
    std::string text() const;

private:
    std::uint64_t first_ = 0xcbf29ce484222325, second_ = 0x84222325cbf29ce4;
};

std::string digest(const std::string& text);
// Throws Error if the file cannot be read.
std::string digest_of_file(const std::string& file);

// FILE.made
std::string note_of(const std::string& file);

enum class Standing { missing, damaged, whole };

// missing: there is no such file. whole: its note says that it was made of `made_of` (one line) and has its bytes'
// hash.
Standing standing(const std::string& file, const std::string& made_of);

// Writes the note of `file`; `bytes` is the digest of what it holds, or will hold. Throws Error.
void write_note(const std::string& file, const std::string& made_of, const std::string& bytes);

}  // namespace mandelmarch
