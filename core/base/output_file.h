// SPDX-License-Identifier: Apache-2.0
// Output that appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/temporary_path.h"

namespace mandelmarch {

// Writes beside the target and renames on commit(). A stream is written into instead and never replaced. A symbolic
// link stays; its target is replaced, or made. Errors are thrown as Error with the path and the cause.
class OutputFile {
public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();  // without a commit(), what was written beside the target is removed; see TemporaryPath for signals
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size);
    // The next write goes to `offset` bytes from the beginning. Not for streams.
    void seek(std::uint64_t offset);
    void commit();

    // Throws InputError if the target certainly cannot be written: its folder is missing or not writable, or it is a
    // folder itself, or a new name in /dev. Touches nothing.
    static void check(const std::string& path);

    // True if the target exists and is neither a regular file nor a folder (a device, a pipe), or is named in /proc, as
    // /dev/stdout, /dev/stderr and /dev/fd/N are. The last are written into as a shell would, also where they are
    // files.
    static bool is_stream(const std::string& path);

private:
    [[noreturn]] void fail(const char* action) const;

    std::string path_;                        // as the user named it
    std::string target_;                      // what is replaced; empty for a stream
    std::optional<TemporaryPath> temporary_;  // beside it
    int descriptor_ = -1;
};

// Writes a whole file, as OutputFile does.
void write_file(const std::string& path, std::string_view text);

}  // namespace mandelmarch
