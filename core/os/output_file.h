// SPDX-License-Identifier: Apache-2.0
// Output files that appear completely or not at all.
//     OutputFile::check(path);  // before the work: refuses a path that cannot be written
//     write_file(path, text);   // or OutputFile file(path); file.write(...); file.commit();
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/os/files.h"
#include "core/os/temporary_path.h"

namespace mandelmarch {

// Writes to a temporary file next to the target. commit() renames the temporary file to the target or, where the file
// system forbids that, writes its content into the target. At a name that the user gave, a stream (see is_stream) is
// written directly; if the path is a symbolic link, the link is kept, and the file that it refers to is replaced or
// created. Errors are thrown as Error, with the path and the cause.
class OutputFile {
public:
    explicit OutputFile(const std::string& path, NamedBy named = NamedBy::user);
    ~OutputFile();  // removes the temporary file unless commit() was called; for signals see TemporaryPath
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size);
    // Sets the position of the next write, in bytes from the beginning. Must not be called for a stream.
    void seek(std::uint64_t offset);
    // If the target can be neither replaced nor written, keeps the temporary file, and names it in the message.
    void commit();

    // Throws InputError if the target certainly cannot be written: for example, if it is a folder, or if its folder is
    // missing or not writable. Changes nothing.
    static void check(const std::string& path, NamedBy named = NamedBy::user);

    // Returns true if the path refers to a device, a pipe, or another existing object that is neither a regular file
    // nor a folder. Also returns true if the path is in /proc or a link to there, as /dev/stdout, /dev/stderr and
    // /dev/fd/N are. Like a shell, OutputFile then writes to the file directly, even if it is a regular file.
    static bool is_stream(const std::string& path);

private:
    [[noreturn]] void fail(const char* action) const;
    void finish();
    void write_into_target(const std::string& from);

    std::string path_;  // as given
    NamedBy named_;
    std::string target_;                      // the file to replace; empty for a stream
    std::optional<TemporaryPath> temporary_;  // next to the target
    int descriptor_ = -1;
};

// Writes a whole file through OutputFile.
void write_file(const std::string& path, std::string_view text, NamedBy named = NamedBy::user);

// Flushes a file to the disk. Returns false, with the cause in errno, if data may be lost. A file system that cannot
// flush files is no failure.
bool flush_to_disk(int descriptor);

}  // namespace mandelmarch
