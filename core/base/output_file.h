// SPDX-License-Identifier: Apache-2.0
// Output files that appear completely or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/temporary_path.h"

namespace mandelmarch {

// Writes to a temporary file next to the target. commit() renames the temporary file to the target. A stream (see
// is_stream) is written directly. If the path is a symbolic link, the link is kept, and the file that it refers to is
// replaced or created. Errors are thrown as Error, with the path and the cause.
class OutputFile {
public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // removes the temporary file unless commit() was called; for signals see TemporaryPath
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size);
    // Sets the position of the next write, in bytes from the beginning. Must not be called for a stream.
    void seek(std::uint64_t offset);
    void commit();

    // Throws InputError if the target certainly cannot be written: for example, if it is a folder, or if its folder is
    // missing or not writable. Changes nothing.
    static void check(const std::string& path);

    // Returns true if the path refers to a device, a pipe, or another existing object that is neither a regular file
    // nor a folder. Also returns true if the path is in /proc or a link to there, as /dev/stdout, /dev/stderr and
    // /dev/fd/N are. Like a shell, OutputFile then writes to the file directly, even if it is a regular file.
    static bool is_stream(const std::string& path);

private:
    [[noreturn]] void fail(const char* action) const;

    std::string path_;                        // as given by the user
    std::string target_;                      // the file to replace; empty for a stream
    std::optional<TemporaryPath> temporary_;  // next to the target
    int descriptor_ = -1;
};

// Writes a whole file through OutputFile.
void write_file(const std::string& path, std::string_view text);

}  // namespace mandelmarch
