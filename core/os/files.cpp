// SPDX-License-Identifier: Apache-2.0
#include "core/os/files.h"

#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // max length of a chain of links, as in Linux

// Returns the status of a file, following links; nullopt if the file does not exist.
std::optional<struct stat> status_of(const std::string& path)
{
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return std::nullopt;
    return status;
}

}  // namespace

std::vector<std::string> files_in(const std::string& folder)
{
    std::vector<std::string> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path().string());
    std::ranges::sort(files);
    return files;
}

std::string first_line(const std::string& path)
{
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

TemporaryFolder::TemporaryFolder()
{
    std::error_code failed;
    const fs::path folder = fs::temp_directory_path(failed);
    if (failed) throw Error(fmt::format("the folder of temporary files (TMPDIR): {}", failed.message()));
    std::string name = (folder / "mandelmarch-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
    path_ = name;
    removed_.emplace(name);
}

TemporaryFolder::~TemporaryFolder()
{
    removed_.reset();
    if (std::error_code none; fs::exists(path_, none)) say("{}: the folder cannot be removed\n", path_.string());
}

std::string folder_of(const std::string& path)
{
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

bool in_proc(const std::string& path)
{
    struct statfs system {};
    return statfs(folder_of(path).c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
}

std::string end_of_links(const std::string& path)
{
    fs::path at = path;
    for (int links = 0; links <= most_links; ++links) {
        std::error_code error;
        if (in_proc(at.string())) return at.string();
        const fs::path next = fs::read_symlink(at, error);
        if (error) return at.string();  // not a link
        at = at.parent_path() / next;   // if `next` is absolute, the result is `next`
    }
    throw InputError(fmt::format("{}: {}, expected a file", path, std::strerror(ELOOP)));
}

bool same_file(const std::string& a, const std::string& b)
{
    const auto first = status_of(a);
    const auto second = status_of(b);
    if (first || second) return first && second && first->st_dev == second->st_dev && first->st_ino == second->st_ino;
    const auto whole = [](const std::string& path) { return fs::weakly_canonical(fs::absolute(end_of_links(path))); };
    return whole(a) == whole(b);
}

void refuse_shared_files(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read)
{
    const auto compare = [](const NamedFile& a, const NamedFile& b) {
        if (a.path.empty() || b.path.empty() || !same_file(a.path, b.path)) return;
        if (const auto status = status_of(a.path); status && S_ISCHR(status->st_mode)) return;
        throw InputError(fmt::format("{}: {} and {} are the same file, expected two files", a.path, a.name, b.name));
    };
    constexpr VariableName log = "MANDELMARCH_DRIVER_LOG";
    for (std::size_t i = 0; i < written.size(); ++i) {
        compare(written[i], {log.text, environment_variable(log)});
        for (std::size_t other = i + 1; other < written.size(); ++other) compare(written[i], written[other]);
        for (const NamedFile& file : read) compare(written[i], file);
    }
}

}  // namespace mandelmarch
