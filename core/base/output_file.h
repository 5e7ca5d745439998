// SPDX-License-Identifier: Apache-2.0
// Output files that appear complete or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/temporary_path.h"

namespace mandelmarch {

// Writes to a temporary file next to the target; commit() renames it. Writes directly into a stream. A symbolic link is
// kept; its target is replaced, or created. Errors are thrown as Error with the path and the cause.
class OutputFile {
public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // without a commit(), removes the temporary file; for signals see TemporaryPath
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size);
    // Sets the position of the next write, in bytes from the beginning. Not for streams.
    void seek(std::uint64_t offset);
    void commit();

    // Throws InputError if the target certainly cannot be written: its folder is missing or not writable, or it is a
    // folder. Changes nothing.
    static void check(const std::string& path);

    // True if the target exists and is neither a regular file nor a folder (a device, a pipe), or if its name is in
    // /proc, as for /dev/stdout, /dev/stderr and /dev/fd/N. The latter are written directly, as by a shell, even if
    // they are regular files.
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
