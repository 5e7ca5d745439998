// SPDX-License-Identifier: Apache-2.0
#include "core/os/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/os/files.h"
#include "core/os/input_file.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

// Returns N if the path refers to this process's descriptor N, as /dev/stdout and /dev/fd/N do; otherwise nullopt.
std::optional<int> own_descriptor(const std::string& path)
{
    const std::string end = end_of_links(path);
    if (!same_file(folder_of(end), "/proc/self/fd")) return std::nullopt;
    const std::string name = fs::path(end).filename().string();
    int number = -1;
    const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc() || rest != name.data() + name.size()) return std::nullopt;
    return number;
}

bool writable(int descriptor)
{
    const int flags = fcntl(descriptor, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) errno = EBADF;
    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

// Returns true if there is a file that can be neither replaced by renaming another to it nor written. A file cannot be
// replaced if it is mounted or immutable, or if it is another user's in a folder with the sticky bit, such as /tmp.
bool is_fixed(const std::string& file, const std::string& folder)
{
    struct statx found {};
    struct stat around {};
    constexpr unsigned asked = STATX_TYPE | STATX_UID;
    if (statx(AT_FDCWD, file.c_str(), AT_SYMLINK_NOFOLLOW, asked, &found) != 0) return false;
    const uid_t user = geteuid();
    const bool sticky = user != 0 && stat(folder.c_str(), &around) == 0 && (around.st_mode & S_ISVTX) != 0 &&
                        found.stx_uid != user && around.st_uid != user;
    const bool stays = sticky || (found.stx_attributes & (STATX_ATTR_MOUNT_ROOT | STATX_ATTR_IMMUTABLE)) != 0;
    return stays && (!S_ISREG(found.stx_mode) || access(file.c_str(), W_OK) != 0);
}

}  // namespace

bool flush_to_disk(int descriptor)
{
    return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP || errno == EPERM;
}

bool OutputFile::is_stream(const std::string& path)
{
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return !S_ISDIR(status.st_mode);
    return in_proc(end_of_links(path));
}

void OutputFile::check(const std::string& path, NamedBy named)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: {}, expected a file that can be written", path, why));
    };
    if (path.empty()) throw InputError("the output file's name is empty, expected a file name");
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) refuse("it is a directory");
    if (named == NamedBy::user && is_stream(path)) {
        const auto own = own_descriptor(path);
        if (own ? !writable(*own) : access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
        return;
    }
    const std::string target = named == NamedBy::user ? end_of_links(path) : path;
    const std::string folder = folder_of(target);
    if (!fs::is_directory(folder, ignored)) refuse("the folder " + folder + " is missing");
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(fmt::format("folder {}: {}", folder, std::strerror(errno)));
    if (fs::path(target).filename().string().size() > NAME_MAX) refuse("the name is too long");
    if (is_fixed(target, folder)) refuse("it is another user's, or mounted, and can be neither replaced nor written");
}

OutputFile::OutputFile(const std::string& path, NamedBy named) : path_(path), named_(named)
{
    if (named == NamedBy::user && is_stream(path)) {
        const auto own = own_descriptor(path);
        descriptor_ = own ? fcntl(*own, F_DUPFD_CLOEXEC, 0) : open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) fail("open");
        return;
    }
    target_ = named == NamedBy::user ? end_of_links(path) : path;
    try {
        temporary_.emplace(folder_of(target_) + "/.mandelmarch-", descriptor_);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", path, error.what()));
    }
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) close(descriptor_);
}

void OutputFile::fail(const char* action) const
{
    throw Error(fmt::format("{}: cannot {} it: {}", path_, action, std::strerror(errno)));
}

void OutputFile::write(const void* data, std::size_t size)
{
    const char* next = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::write(descriptor_, next, size);
        if (written < 0) {
            if (errno == EINTR) continue;
            fail("write");
        }
        next += written;
        size -= static_cast<std::size_t>(written);
    }
}

void OutputFile::seek(std::uint64_t offset)
{
    if (lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) fail("seek in");
}

// Flushes and closes the file.
void OutputFile::finish()
{
    if (temporary_ && !flush_to_disk(descriptor_)) fail("write");
    if (close(std::exchange(descriptor_, -1)) != 0) fail("close");
}

void OutputFile::write_into_target(const std::string& from)
{
    InputFile whole(from, "file");
    descriptor_ = open(target_.c_str(), O_WRONLY | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0) fail("write");
    for (std::string part; whole.next(part);) write(part.data(), part.size());
    finish();
}

void OutputFile::commit()
{
    if (temporary_) {
        // A new file gets the permissions that the umask leaves. A replaced file's permissions are kept, but not that
        // the file runs with its owner's rights.
        struct stat old {};
        const mode_t mask = umask(0);
        umask(mask);
        const bool replaces = lstat(target_.c_str(), &old) == 0 && S_ISREG(old.st_mode);
        const mode_t mode = replaces ? old.st_mode & 0777 : 0666 & ~mask;
        if (fchmod(descriptor_, mode) != 0 && named_ == NamedBy::user) {
            say("{}: its rights stay as they are: {}\n", printable(path_), std::strerror(errno));
        }
    }
    finish();
    if (!temporary_ || temporary_->rename_to(target_)) return;
    const std::string whole = temporary_->path();
    try {
        if (errno != EBUSY && errno != EPERM && errno != EACCES) fail("rename a file to");
        temporary_->keep();  // also if a signal ends the program now
        write_into_target(whole);
        unlink(whole.c_str());
    } catch (const Error& error) {
        temporary_->keep();
        if (named_ == NamedBy::program) unlink(whole.c_str());
        if (access(whole.c_str(), F_OK) != 0) throw;
        throw Error(fmt::format("{}; what was to be written is in {}", error.what(), whole));
    }
}

void write_file(const std::string& path, std::string_view text, NamedBy named)
{
    OutputFile file(path, named);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace mandelmarch
