// SPDX-License-Identifier: Apache-2.0
// Temporary files that are removed when the process ends.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

namespace mandelmarch {

// The path of a temporary file. The destructor removes the file unless it was renamed. SIGINT, SIGTERM and SIGHUP
// remove it, too, and then end the process as usual; a signal that is ignored or has a handler is left unchanged.
class TemporaryPath {
public:
    // For a file created by other code.
    explicit TemporaryPath(std::string path);
    // Creates an empty file, named `prefix` and eight characters, and opens it for writing. Throws Error with name and
    // cause.
    TemporaryPath(const std::string& prefix, int& descriptor);
    ~TemporaryPath();
    TemporaryPath(const TemporaryPath&) = delete;
    TemporaryPath& operator=(const TemporaryPath&) = delete;

    const std::string& path() const { return path_; }

    // Renames the file to its final name and replaces a file of that name; returns false and sets errno on failure.
    bool rename_to(const std::string& target);

private:
    std::string path_;  // empty after renaming
    pid_t owner_;       // a forked process does not own the file
    std::size_t slot_;  // of the name, for signals
};

}  // namespace mandelmarch
