// SPDX-License-Identifier: Apache-2.0
// Files that are read wholly or not at all. An error in the middle of a file never counts as its end.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/os/descriptor.h"
#include "core/os/files.h"

namespace mandelmarch {

// A file that is read from its beginning to its end. Failures are thrown with the path, the cause and the expected kind
// of file: as InputError or, if the program named the file, as Error.
class InputFile {
public:
    // Opens the file. `kind`: what is expected, such as "path file". At a name of the program, only a regular file is
    // read.
    InputFile(std::string path, std::string_view kind, NamedBy named = NamedBy::user);

    // Appends up to `size` bytes of the file to `data`. Appends fewer only if the file ends. A file that exceeds the
    // available memory is refused.
    void append(std::string& data, std::size_t size);

    // Reads the next part of the file. Returns false at the end.
    bool next(std::string& part);

    [[noreturn]] void refuse(const std::string& why) const;

private:
    std::string path_, kind_;
    NamedBy named_;
    Descriptor file_;
    std::size_t step_ = 0;  // bytes read at once
};

inline constexpr std::size_t largest_text = std::size_t{64} << 20;  // bytes

// Returns the content of a UTF-8 text file that the user named, without its byte order mark. Throws InputError if it
// cannot be read, has more than `most` bytes, or is no text. `kind`: as for InputFile.
std::string text_of_file(const std::string& path, std::string_view kind, std::size_t most = largest_text);

// Returns the content of a file that the program itself wrote in an earlier run, or nullopt if something else is there:
// no file, not a regular file, one that cannot be read, or one of more than `largest_text` bytes.
std::optional<std::string> own_file(const std::string& path);

}  // namespace mandelmarch
