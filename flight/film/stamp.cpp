// SPDX-License-Identifier: Apache-2.0
#include "flight/film/stamp.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/base/output_file.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece = 1 << 20;  // bytes read at once

// Returns the content of a stamp.
std::string stamp_text(const std::string& made_of, const std::string& bytes)
{
    return fmt::format("{}\n{}\n", made_of, bytes);
}

}  // namespace

void Digest::add(const void* data, std::size_t size)
{
    first_ = fnv1a(data, size, first_);
    second_ = fnv1a(data, size, second_);
}

std::string Digest::text() const { return fmt::format("{:016x}{:016x}", first_, second_); }

std::string digest(const std::string& text)
{
    Digest made;
    made.add(text.data(), text.size());
    return made.text();
}

std::string digest_of_file(const std::string& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string part(piece, '\0');
    Digest made;
    do {
        stream.read(part.data(), static_cast<std::streamsize>(part.size()));
        made.add(part.data(), static_cast<std::size_t>(stream.gcount()));
    } while (stream);
    if (!stream.eof()) throw Error(fmt::format("{}: cannot be read", file));
    return made.text();
}

std::string stamp_path(const std::string& file) { return file + ".made"; }

FileState state_of(const std::string& file, const std::string& made_of)
{
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return FileState::missing;
    const std::string note = stamp_path(file);
    if (!fs::is_regular_file(file, error) || !fs::is_regular_file(note, error)) return FileState::damaged;
    // Reads at most one byte more than a stamp has, because the file may be a large one that is not a stamp.
    const std::string likeness = stamp_text(made_of, digest(""));
    std::string text(likeness.size() + 1, '\0');
    std::ifstream stream(note, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (!text.starts_with(made_of + "\n") || text.size() != likeness.size()) return FileState::damaged;
    return text == stamp_text(made_of, digest_of_file(file)) ? FileState::whole : FileState::damaged;
}

void write_note(const std::string& file, const std::string& made_of, const std::string& bytes)
{
    const std::string text = stamp_text(made_of, bytes);
    OutputFile note(stamp_path(file));
    note.write(text.data(), text.size());
    note.commit();
}

}  // namespace mandelmarch
