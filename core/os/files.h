// SPDX-License-Identifier: Apache-2.0
// File names and the files that they refer to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/os/temporary_path.h"

namespace mandelmarch {

// Who chose a file's name. If the user did, the program follows links, and reads and writes pipes and devices. If the
// program did, as it chose VIDEO.made, somebody else has put them there: the program reads regular files only, and what
// it writes replaces a link, a pipe or a device.
enum class NamedBy { user, program };

// Follows a chain of symbolic links and returns the last name, whose file may not exist yet. Stops at a name in /proc,
// because such a name refers to a file that is already open. Throws InputError if the links are circular.
std::string end_of_links(const std::string& path);

// Returns true if the name is in a folder of /proc. Such a name refers to a virtual file or to a file that is already
// open.
bool in_proc(const std::string& path);

// Returns the paths of a folder's entries, sorted; empty if the folder cannot be read.
std::vector<std::string> files_in(const std::string& folder);

// Returns the first line of a file; empty if the file cannot be read.
std::string first_line(const std::string& path);

// A new folder in the system's temporary folder, removed with its contents as a TemporaryPath is. Prints a line if
// something of it cannot be removed.
class TemporaryFolder {
public:
    TemporaryFolder();  // throws Error
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::optional<TemporaryPath> removed_;
};

// Returns the folder of a path; "." if it has none.
std::string folder_of(const std::string& path);

// Returns true if both names refer to the same file, by any spelling or link, even if the file does not exist yet.
bool same_file(const std::string& a, const std::string& b);

// A file on a command line: its path, empty if not given, and what messages call it, such as the option's name.
struct NamedFile {
    std::string name;
    std::string path;
};

// Throws InputError if two of the written files, or a written file and a read file, are the same file. The log of
// drivers (MANDELMARCH_DRIVER_LOG) counts as a written file. Devices (/dev/null, a terminal) may be given twice.
void refuse_shared_files(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read = {});

}  // namespace mandelmarch
