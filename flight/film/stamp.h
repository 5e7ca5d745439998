// SPDX-License-Identifier: Apache-2.0
// Stamps of finished files. The stamp FILE.made contains the digest of the file's inputs and the digest of its bytes.
// With them, a finished file can be distinguished from one that is damaged or was made from other inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/text/hash.h"

namespace mandelmarch {

// A hash of 32 hexadecimal digits. It consists of two 64-bit FNV-1a hashes with different initial values.
class Digest {
public:
    void add(const void* data, std::size_t size);
    std::string text() const;

private:
    std::uint64_t first_ = fnv1a_start, second_ = 0x84222325cbf29ce4;
};

std::string digest(const std::string& text);
// Throws Error if the file cannot be read.
std::string digest_of_file(const std::string& file);

// Returns the path of a file's stamp.
std::string stamp_path(const std::string& file);

enum class FileState { missing, damaged, whole };

// Returns `missing` if the file does not exist, `whole` if its stamp matches its bytes and `made_of`, else `damaged`.
// `made_of`: one line that identifies the file's inputs, such as the digest of their description.
FileState state_of(const std::string& file, const std::string& made_of);

// Writes the stamp of `file`; the file itself need not exist yet. `bytes`: the digest of the file's content. Throws
// Error if the stamp cannot be written.
void write_note(const std::string& file, const std::string& made_of, const std::string& bytes);

}  // namespace mandelmarch
