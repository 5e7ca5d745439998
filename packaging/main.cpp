// SPDX-License-Identifier: Apache-2.0
// All programs of the bundle in one executable, which uses the bundled drivers for CPUs, font and ffmpeg. The name by
// which it is called selects the program; if that name is not a program's, the first argument does.
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/environment.h"
#include "core/text/error.h"

#define PROGRAM(name) int name##_main(int argc, char** argv);
#include "programs.inc"
#undef PROGRAM

namespace {

using namespace mandelmarch;
namespace fs = std::filesystem;

bool is_set(VariableName name) { return !environment_variable(name).empty(); }

bool is_there(const fs::path& path)
{
    std::error_code ignored;
    return fs::exists(path, ignored);
}

void name_file(VariableName variable, const fs::path& file)
{
    if (!is_set(variable) && is_there(file)) setenv(variable.text, file.c_str(), 1);
}

std::vector<fs::path> files_of(const fs::path& folder, const char* extension)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() == extension) files.push_back(at->path());
    }
    return files;
}

std::string contents(const fs::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Makes and returns a folder of links to `files`, or returns an empty path on failure. OpenCL's loader reads only one
// folder. Therefore the system's drivers and the bundle's must be in the same folder, and the bundle may be read-only.
// The new folder must belong to the user alone: in a shared folder, others could replace the links.
fs::path folder_of_links(const std::vector<fs::path>& files)
{
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error) / ("mandelmarch-opencl-" + std::to_string(geteuid()));
    if (error) return {};
    mkdir(folder.c_str(), 0700);
    struct stat status {};
    if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
        (status.st_mode & 077) != 0) {
        return {};
    }
    for (const fs::path& link : files_of(folder, ".icd")) {
        if (!is_there(link)) fs::remove(link, error);
    }
    for (const fs::path& file : files) {
        const fs::path link = folder / file.filename();
        if (fs::read_symlink(link, error) == file) continue;
        // Makes a new link and renames it over the old one, because another program may be reading the folder.
        const fs::path fresh = folder / (file.filename().string() + "." + std::to_string(getpid()));
        fs::create_symlink(file, fresh, error);
        fs::rename(fresh, link, error);
        if (error) return {};
    }
    return folder;
}

// Adds PoCL to the drivers that OpenCL's loader opens. PoCL calls ld for each kernel. The folder `tools`, which is put
// first on PATH, has an ld that works without glibc's development files.
void add_opencl(const fs::path& pocl, const fs::path& tools)
{
    if (!is_there(pocl) || is_set("OCL_ICD_VENDORS") || is_set("OPENCL_VENDOR_PATH")) return;
    std::vector<fs::path> files = files_of("/etc/OpenCL/vendors", ".icd");
    for (const fs::path& file : files) {
        if (contents(file).find("libpocl") != std::string::npos) return;
    }
    const bool alone = files.empty();
    files.push_back(pocl);
    const fs::path folder = alone ? pocl.parent_path() : folder_of_links(files);
    if (folder.empty()) return;
    setenv("OCL_ICD_VENDORS", folder.c_str(), 1);
    const std::string others = is_set("PATH") ? environment_variable("PATH") : "/usr/local/bin:/usr/bin:/bin";
    setenv("PATH", (tools.string() + ":" + others).c_str(), 1);
}

void add_vulkan(const fs::path& lavapipe)
{
    if (!is_there(lavapipe)) return;
    constexpr std::array folders{"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"};
    for (const char* folder : folders) {
        for (const fs::path& file : files_of(folder, ".json")) {
            if (contents(file).find("libvulkan_lvp") != std::string::npos) return;
        }
    }
    const std::string others = is_set("VK_ADD_DRIVER_FILES") ? environment_variable("VK_ADD_DRIVER_FILES") + ":" : "";
    if (others.find(lavapipe.string() + ":") != std::string::npos) return;
    setenv("VK_ADD_DRIVER_FILES", (others + lavapipe.string()).c_str(), 1);
}

// Returns the folder that holds bin/, lib/ and share/.
fs::path bundle_folder()
{
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
}

// Sets environment variables for the loaders of OpenCL and Vulkan, and for the film, before anything is loaded. The
// system's drivers stay available. A bundled driver is left out if the system has the same one. Variables that are
// already set are not changed.
void use_carried(const fs::path& bundle)
{
    const fs::path share = bundle / "share";
    name_file("MANDELMARCH_FONT", share / "fonts/DejaVuSans.ttf");
    name_file("MANDELMARCH_FFMPEG", bundle / "libexec/ffmpeg");
    add_opencl(share / "OpenCL/vendors/pocl.icd", bundle / "libexec/pocl");
    add_vulkan(share / "vulkan/icd.d/lvp_icd.json");
}

struct Program {
    std::string_view name;
    int (*main)(int, char**);
};

constexpr std::array programs{
#define PROGRAM(name) Program{#name, name##_main},
#include "programs.inc"
#undef PROGRAM
};

const Program* find(std::string_view path)
{
    const std::string_view name = path.substr(path.rfind('/') + 1);
    for (const Program& program : programs) {
        if (program.name == name) return &program;
    }
    return nullptr;
}

int usage(bool wanted)
{
    std::FILE* out = wanted ? stdout : stderr;
    std::fputs("mandelmarch PROGRAM [ARGUMENT]...\nprograms:", out);
    for (const Program& program : programs) std::fprintf(out, " %s", program.name.data());
    std::fputs("\n", out);
    return wanted ? exit_success : exit_usage;
}

}  // namespace

int main(int argc, char** argv)
{
    const Program* program = argc > 0 ? find(argv[0]) : nullptr;
    if (program == nullptr) {
        if (argc < 2) return usage(false);
        program = find(argv[1]);
        if (program == nullptr) return usage(std::string_view(argv[1]) == "--help");
        --argc;
        ++argv;
        program_invocation_name = argv[0];
    }
    use_carried(bundle_folder());
    return program->main(argc, argv);
}
