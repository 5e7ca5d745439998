// SPDX-License-Identifier: Apache-2.0
#include "flight/film/stamp.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/os/input_file.h"
#include "core/os/output_file.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

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
    InputFile input(file, "file", NamedBy::program);
    Digest made;
    for (std::string part; input.next(part);) made.add(part.data(), part.size());
    return made.text();
}

std::string stamp_path(const std::string& file) { return file + ".made"; }

FileState state_of(const std::string& file, const std::string& made_of)
{
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return FileState::missing;
    if (!fs::is_regular_file(file, error)) return FileState::damaged;
    const auto text = own_file(stamp_path(file));
    if (!text || !text->starts_with(made_of + "\n")) return FileState::damaged;
    return *text == stamp_text(made_of, digest_of_file(file)) ? FileState::whole : FileState::damaged;
}

void write_note(const std::string& file, const std::string& made_of, const std::string& bytes)
{
    write_file(stamp_path(file), stamp_text(made_of, bytes), NamedBy::program);
}

}  // namespace mandelmarch
