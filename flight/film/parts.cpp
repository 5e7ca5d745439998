// SPDX-License-Identifier: Apache-2.0
#include "flight/film/parts.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/output_file.h"

namespace mandelmarch {

std::string parts_folder(const std::string& film, const std::string& made_of)
{
    if (!OutputFile::is_stream(film)) return end_of_links(film) + ".parts";
    std::error_code error;
    const auto scratch = std::filesystem::temp_directory_path(error);
    if (error)
        throw InputError(fmt::format("TMPDIR: {}, expected a folder for the parts of {}", error.message(), film));
    return fmt::format("{}/mandelmarch-film-{}-{}", scratch.string(), geteuid(), made_of);
}

void make_private_folder(const std::string& folder)
{
    if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
        throw Error(fmt::format("{}: cannot make the folder: {}", folder, std::strerror(errno)));
    }
    struct stat status {};
    const bool own = lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
                     (status.st_mode & 022) == 0;
    if (!own) throw Error(fmt::format("{}: not a folder that only this user can change", folder));
}

}  // namespace mandelmarch
