// SPDX-License-Identifier: Apache-2.0
#include "core/os/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/os/memory.h"
#include "core/text/error.h"

namespace mandelmarch {

InputFile::InputFile(std::string path, std::string_view kind, NamedBy named)
    : path_(std::move(path)),
      kind_(kind),
      named_(named),
      // Opening a pipe waits for its writer. The user may have meant that, the program never does.
      file_(open(path_.c_str(), O_RDONLY | O_CLOEXEC | (named == NamedBy::program ? O_NONBLOCK : 0)))
{
    constexpr std::size_t least = 1 << 16;
    struct stat status {};
    if (file_.number() < 0 || fstat(file_.number(), &status) != 0) refuse(std::strerror(errno));
    if (named == NamedBy::program && !S_ISREG(status.st_mode)) refuse("it is not a regular file");
    step_ = std::max(least, static_cast<std::size_t>(status.st_size) + 1);
}

void InputFile::refuse(const std::string& why) const
{
    const std::string text = fmt::format("{}: {}, expected a {}", path_, why, kind_);
    if (named_ == NamedBy::program) throw Error(text);
    throw InputError(text);
}

void InputFile::append(std::string& data, std::size_t size)
{
    while (size > 0) {
        const std::size_t end = data.size() + std::min(size, step_);
        if (end > available_memory()) refuse("it is larger than the memory available");
        size -= end - data.size();
        std::size_t at = data.size();
        data.resize(end);
        while (at < end) {
            const ssize_t got = read(file_.number(), data.data() + at, end - at);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) refuse(std::strerror(errno));
            if (got == 0) return data.resize(at);
            at += static_cast<std::size_t>(got);
        }
        step_ = std::max(step_, data.size());  // the size of a pipe is unknown
    }
}

bool InputFile::next(std::string& part)
{
    part.clear();
    append(part, 1 << 20);
    return !part.empty();
}

std::string text_of_file(const std::string& path, std::string_view kind, std::size_t most)
{
    constexpr std::size_t beginning = 4096;  // bytes; enough to refuse other files before they are read
    InputFile file(path, kind);
    std::string text;
    file.append(text, beginning);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) file.refuse("it is UTF-16, not UTF-8");
    if (text.find('\0') != std::string::npos) file.refuse("it holds a NUL byte");
    file.append(text, most + 1 - std::min(most, text.size()));
    if (text.size() > most) file.refuse(fmt::format("it has more than {} bytes", most));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    return text;
}

std::optional<std::string> own_file(const std::string& path)
{
    try {
        std::string content;
        InputFile(path, "file of this program", NamedBy::program).append(content, largest_text + 1);
        return content.size() <= largest_text ? std::optional(std::move(content)) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace mandelmarch
