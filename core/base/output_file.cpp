// SPDX-License-Identifier: Apache-2.0
#include "core/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <climits>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files.h"

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

}  // namespace

bool OutputFile::is_stream(const std::string& path)
{
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return !S_ISDIR(status.st_mode);
    return in_proc(end_of_links(path));
}

void OutputFile::check(const std::string& path)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError(fmt::format("{}: {}, expected a file that can be written", path, why));
    };
    if (path.empty()) throw InputError("the output file's name is empty, expected a file name");
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) refuse("it is a directory");
    if (is_stream(path)) {
        const auto own = own_descriptor(path);
        if (own ? !writable(*own) : access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
        return;
    }
    const std::string target = end_of_links(path);
    const std::string folder = folder_of(target);
    if (!fs::is_directory(folder, ignored)) refuse("the folder " + folder + " is missing");
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(fmt::format("folder {}: {}", folder, std::strerror(errno)));
    if (fs::path(target).filename().string().size() > NAME_MAX) refuse("the name is too long");
}

OutputFile::OutputFile(const std::string& path) : path_(path)
{
    if (is_stream(path)) {
        const auto own = own_descriptor(path);
        descriptor_ = own ? fcntl(*own, F_DUPFD_CLOEXEC, 0) : open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) fail("open");
        return;
    }
    target_ = end_of_links(path);
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

void OutputFile::commit()
{
    if (temporary_) {
        // A new file gets the permissions that the umask leaves; a replaced file's permissions are kept.
        struct stat old {};
        const mode_t mask = umask(0);
        umask(mask);
        const mode_t mode = stat(target_.c_str(), &old) == 0 ? old.st_mode & 07777 : 0666 & ~mask;
        if (fchmod(descriptor_, mode) != 0) fail("set the rights of");
        if (fsync(descriptor_) != 0) fail("write");
    }
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (close(descriptor) != 0) fail("close");
    if (temporary_ && !temporary_->rename_to(target_)) fail("rename a file to");
}

void write_file(const std::string& path, std::string_view text)
{
    OutputFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace mandelmarch
