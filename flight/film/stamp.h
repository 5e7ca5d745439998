// SPDX-License-Identifier: Apache-2.0
// Stamps of finished files. The stamp FILE.made holds the digest of the file's inputs and a hash of its bytes, by which
// a finished file can be distinguished from one that is damaged or outdated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace mandelmarch {

// A hash as 32 hexadecimal digits: two FNV-1a hashes of 64 bits.
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

// Returns the path of the stamp, FILE.made.
std::string stamp_path(const std::string& file);

enum class FileState { missing, damaged, whole };

// Returns `missing` if the file does not exist, `whole` if its stamp matches its bytes and `made_of` (one line), else
// `damaged`.
FileState state_of(const std::string& file, const std::string& made_of);

// Writes the stamp of `file`. `bytes`: the digest of the file's present or future content. Throws Error.
void write_note(const std::string& file, const std::string& made_of, const std::string& bytes);

}  // namespace mandelmarch
