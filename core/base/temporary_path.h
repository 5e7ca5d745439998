// SPDX-License-Identifier: Apache-2.0
// Files that are in the making go with the process that makes them.
#pragma once

#include <string>

namespace mandelmarch {

// The name of a file in the making. The file is removed when this goes, unless it was renamed, and when the process is
// ended by SIGINT, SIGTERM or SIGHUP, which it then still ends by. A signal that is ignored or has a handler stays as
// it is.
class TemporaryPath {
public:
    // Of a file that something else makes.
    explicit TemporaryPath(std::string path);
    // Makes an empty file, `prefix` and six characters, and opens it for writing. Throws Error with name and cause.
    TemporaryPath(const std::string& prefix, int& descriptor);
    ~TemporaryPath();
    TemporaryPath(const TemporaryPath&) = delete;
    TemporaryPath& operator=(const TemporaryPath&) = delete;

    const std::string& path() const { return path_; }

    // Gives the file its name for good, in the place of what has that name; false with errno where it cannot.
    bool rename_to(const std::string& target);

private:
    std::string path_;  // empty: renamed
};

}  // namespace mandelmarch
