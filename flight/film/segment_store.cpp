// SPDX-License-Identifier: Apache-2.0
#include "flight/film/segment_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/os/files.h"
#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/text/console.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr const char* part_prefix = ".part-";
constexpr const char* lock_name = "/lock";
constexpr int most_tries = 100;

// Returns true if `name` still names the open file, and false if another run has removed the file.
bool still_there(int descriptor, const std::string& name)
{
    struct stat held {};
    struct stat named {};
    return fstat(descriptor, &held) == 0 && stat(name.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
           held.st_ino == named.st_ino;
}

// Creates a folder if it does not exist. A link in its place is refused: it could lead to another user's files.
void make_folder(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error(fmt::format("{}: cannot make the folder: {}", folder, error.message()));
    if (fs::is_symlink(folder, error)) throw Error(folder + ": it is a link, expected a folder");
}

// Returns the content of a stamp.
std::string stamp_text(const std::string& made_of, const std::string& bytes)
{
    return fmt::format("{}\n{}\n", made_of, bytes);
}

}  // namespace

std::string parts_folder(const std::string& film, const std::string& made_of)
{
    if (!OutputFile::is_stream(film)) return end_of_links(film) + ".parts";
    std::error_code error;
    const auto scratch = std::filesystem::temp_directory_path(error);
    if (error)
        throw InputError(fmt::format("TMPDIR: {}, expected a folder for the parts of {}", error.message(), film));
    return fmt::format("{}/mandelmarch-film-{}-{}", scratch.string(), geteuid(), made_of);
}

void make_private_folder(const std::string& folder)
{
    if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
        throw Error(fmt::format("{}: cannot make the folder: {}", folder, std::strerror(errno)));
    }
    struct stat status {};
    const bool own = lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
                     (status.st_mode & 022) == 0;
    if (!own) throw Error(fmt::format("{}: not a folder that only this user can change", folder));
}

SegmentStore::SegmentStore(const std::string& film, const std::string& parts, const std::string& description,
                           std::size_t frames)
    : film_(film),
      parts_(parts),
      description_(description),
      digest_(digest(description)),
      folder_(fmt::format("{}/{}", parts, digest_)),
      frames_(frames)
{
}

std::size_t SegmentStore::segments() const { return (frames_ + segment_frames - 1) / segment_frames; }

std::size_t SegmentStore::last(std::size_t segment) const { return std::min(frames_, (segment + 1) * segment_frames); }

void SegmentStore::lock(bool shared)
{
    const std::string name = parts_ + lock_name;
    for (int tries = 1;; ++tries) {
        make_folder(parts_);
        lock_ = Descriptor(::open(name.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
        // Another run may have just removed the folder.
        if (lock_.number() < 0 && errno == ENOENT && tries < most_tries) continue;
        if (lock_.number() < 0) throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
        if (flock(lock_.number(), (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK) {
                throw Error(fmt::format("{}: another run makes a film of this name at the moment", film_));
            }
            if (errno != ENOSYS && errno != ENOLCK && errno != EOPNOTSUPP) {
                throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
            }
            say("film: {}: {}, so a second run of this name would not be noticed\n", name, std::strerror(errno));
        }
        if (still_there(lock_.number(), name)) return;
    }
}

void SegmentStore::open(bool shared)
{
    lock(shared);
    make_folder(folder_);
    if (!shared) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder_)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with(part_prefix) || name.starts_with(".mandelmarch-")) fs::remove(entry.path(), error);
        }
    }
    const std::string manifest = folder_ + "/manifest.json";
    if (!own_file(manifest)) write_file(manifest, description_, NamedBy::program);
}

std::string SegmentStore::segment_file(std::size_t segment) const { return fmt::format("segment-{:06}.mp4", segment); }

std::string SegmentStore::part_file(std::size_t segment) const
{
    char host[65] = "host";
    gethostname(host, sizeof host - 1);
    return fmt::format("{}{:06}-{}-{}.mp4", part_prefix, segment, host, getpid());
}

std::string SegmentStore::piece(const std::string& file) const { return digest_ + " " + file; }

FileState SegmentStore::state_of(const std::string& file) const
{
    return mandelmarch::state_of(folder_ + "/" + file, piece(file));
}

void SegmentStore::finish(const std::string& part, const std::string& file) const
{
    const std::string path = folder_ + "/" + part;
    const std::string finished = folder_ + "/" + file;
    // Flushes the file to disk before renaming it, so that a file with the final name is complete even after a power
    // cut.
    const Descriptor written(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (written.number() < 0 || !flush_to_disk(written.number())) {
        throw Error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
    write_note(finished, piece(file), digest_of_file(path));
    std::error_code error;
    fs::rename(path, finished, error);
    if (error) throw Error(fmt::format("{}: cannot be renamed to {}: {}", path, finished, error.message()));
}

std::map<std::string, SegmentStore::Other> SegmentStore::others() const
{
    std::map<std::string, Other> all;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(parts_, error)) {
        if (entry.path().filename() == digest_ || !entry.is_directory(error)) continue;
        const auto manifest = own_file((entry.path() / "manifest.json").string());
        if (!manifest) continue;
        Other other{.description = *manifest};
        for (const std::string& file : files_in(entry.path().string())) {
            const std::string name = fs::path(file).filename().string();
            if (name.starts_with("segment-") && name.ends_with(".mp4")) ++other.segments;
        }
        if (other.segments > 0) all.emplace(entry.path().string(), std::move(other));
    }
    return all;
}

void SegmentStore::close()
{
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    // Removes the folder PARTS, unless it still contains another film's segments.
    fs::remove(parts_ + lock_name, ignored);
    fs::remove(parts_, ignored);
}

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
