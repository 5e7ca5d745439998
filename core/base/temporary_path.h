// SPDX-License-Identifier: Apache-2.0
// Temporary files that are removed when the process ends.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

namespace mandelmarch {

// The path of a temporary file. The destructor removes the file unless it was renamed. SIGINT, SIGTERM and SIGHUP
// also remove the file, and then end the process as usual. A signal that was ignored or had a handler keeps that
// setting, and does not remove the file.
class TemporaryPath {
public:
    // Takes the path of a file that other code creates.
    explicit TemporaryPath(std::string path);
    // Creates an empty file, named `prefix` and eight characters, and opens it for writing. Throws Error with name and
    // cause.
    TemporaryPath(const std::string& prefix, int& descriptor);
    ~TemporaryPath();
    TemporaryPath(const TemporaryPath&) = delete;
    TemporaryPath& operator=(const TemporaryPath&) = delete;

    const std::string& path() const { return path_; }

    // Renames the file to `target`, and replaces a file of that name. If this fails, returns false and sets errno.
    bool rename_to(const std::string& target);

private:
    std::string path_;  // empty after renaming
    pid_t owner_;       // the process that removes the file; one forked from it must not
    std::size_t slot_;  // index of the path in the signal handler's list
};

}  // namespace mandelmarch
