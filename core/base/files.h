// SPDX-License-Identifier: Apache-2.0
// What file a name means.
#pragma once

#include <string>
#include <vector>

namespace mandelmarch {

// The name at the end of a chain of symbolic links; that file need not be there yet. A name in /proc ends the chain:
// what it leads to is open already. Throws InputError where links lead in a circle.
std::string end_of_links(const std::string& path);

// True for a name in a folder of /proc: its file is made by the kernel, or open already.
bool in_proc(const std::string& path);

// The files of a folder, sorted; none where it cannot be read.
std::vector<std::string> files_in(const std::string& folder);

// The folder of a name, "." where it has none.
std::string folder_of(const std::string& path);

// True if both names mean one file, by whatever spelling or link, there or not yet.
bool same_file(const std::string& a, const std::string& b);

// A file that a command line names: what messages call it (an option, say) and its path, empty where it is not given.
struct NamedFile {
    std::string name;
    std::string path;
};

// Throws InputError where a file that is written is also another one, written or read. Devices (/dev/null, a terminal)
// may be shared.
void refuse_shared_files(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read = {});

}  // namespace mandelmarch
