// SPDX-License-Identifier: Apache-2.0
// Temporary files and folders that are removed when the process ends, and child processes that are killed when a signal
// ends it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>

namespace mandelmarch {

// The path of a temporary file, or of a folder with its contents. The destructor removes it unless it was renamed or
// kept. SIGINT, SIGTERM and SIGHUP also remove it, and then end the process as usual. If one of these signals was
// already ignored or had a handler, this setting is kept, and the signal removes nothing.
class TemporaryPath {
public:
    // Takes the path of a file or folder that other code creates.
    explicit TemporaryPath(std::string path);
    // Creates an empty file, whose name is `prefix` and eight more characters, and opens it as `descriptor`. Throws
    // Error with the name and the cause.
    TemporaryPath(const std::string& prefix, int& descriptor);
    ~TemporaryPath();
    TemporaryPath(const TemporaryPath&) = delete;
    TemporaryPath& operator=(const TemporaryPath&) = delete;

    const std::string& path() const { return path_; }

    // Renames the file to `target`. If a file of that name exists, replaces it. Returns false and sets errno if
    // renaming fails.
    bool rename_to(const std::string& target);

    // Leaves the file where it is.
    void keep();

private:
    std::string path_;  // empty after renaming or keeping
    pid_t owner_;       // the process that removes the file; a process forked from it must not
    std::size_t slot_;  // index of the path in the signal handler's list
};

// A process group of children. The signals that remove a TemporaryPath also kill the group, before they remove files.
class KilledGroup {
public:
    explicit KilledGroup(pid_t group);
    ~KilledGroup();
    KilledGroup(const KilledGroup&) = delete;
    KilledGroup& operator=(const KilledGroup&) = delete;

private:
    std::size_t slot_;
};

}  // namespace mandelmarch
