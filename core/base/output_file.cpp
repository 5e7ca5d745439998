#include "core/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

// The file a path means: the end of a chain of symbolic links, if it exists.
std::string resolved(const std::string& path)
{
    std::error_code error;
    const fs::path whole = fs::canonical(path, error);
    return error ? path : whole.string();
}

std::string folder_of(const std::string& path)
{
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace

bool OutputFile::is_stream(const std::string& path)
{
    if (path.starts_with("/dev/") || path.starts_with("/proc/")) return true;
    struct stat status {};
    return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
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
        if (access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
        return;
    }
    const std::string folder = folder_of(resolved(path));
    if (!fs::exists(folder, ignored)) refuse("the folder " + folder + " is missing");
    if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(fmt::format("folder {}: {}", folder, std::strerror(errno)));
    if (fs::path(path).filename().string().size() > NAME_MAX) refuse("the name is too long");
}

OutputFile::OutputFile(const std::string& path) : path_(path)
{
    if (is_stream(path)) {
        descriptor_ = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) fail("open");
        return;
    }
    target_ = resolved(path);
    temporary_ = folder_of(target_) + "/.mandelmarch-XXXXXX";
    descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
    if (descriptor_ < 0) {
        temporary_.clear();
        fail("create a file beside");
    }
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) close(descriptor_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
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
    if (!target_.empty()) {
        // A new file gets the rights that the user's mask leaves; a replaced one keeps its own.
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
    if (target_.empty()) return;
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename a file to");
    temporary_.clear();
}

}  // namespace mandelmarch
