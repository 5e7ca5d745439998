// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/environment.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/os/cores.h"
#include "core/os/cpu.h"
#include "core/os/files.h"
#include "core/os/memory.h"
#include "core/text/environment.h"
#include "core/text/version.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

// Returns the text after the separator in the file's first line that begins with `name`; empty if there is none.
std::string value_in(const fs::path& path, const std::string& name, char separator)
{
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(name)) continue;
        const auto at = line.find(separator);
        if (at == std::string::npos) continue;
        std::string value = line.substr(at + 1);
        std::erase(value, '"');
        value.erase(value.begin(), std::ranges::find_if(value, [](unsigned char c) { return std::isspace(c) == 0; }));
        return value;
    }
    return {};
}

Json caches()
{
    Json list = Json::array();
    for (const Cache& cache : read_caches("/sys/devices/system/cpu/cpu0/cache")) {
        list.push_back({{"level", cache.level}, {"type", cache.type}, {"bytes", cache.bytes}, {"cores", cache.cores}});
    }
    return list;
}

Json cpu()
{
    const Cores mine = cores();
    const fs::path frequency = "/sys/devices/system/cpu/cpu0/cpufreq";
    const Cpu cpu = host_cpu();
    const auto number = [](const std::optional<int>& value) { return value ? Json(*value) : Json(); };
    Json json{{"model", cpu.name},
              {"platform", cpu.platform()},
              {"vendor", cpu.vendor},
              {"family", number(cpu.family)},
              {"model_number", number(cpu.model)},
              {"stepping", number(cpu.stepping)},
              {"vector_extensions", cpu.vectors},
              {"flags", cpu.flags},
              {"caches", caches()},
              {"cores", mine.machine},
              {"cores_given", mine.given},
              {"quota", mine.quota ? Json(*mine.quota) : Json()},
              {"cores_usable", mine.threads()},
              {"binding", or_null(binding())},
              {"governor", or_null(first_line(frequency / "scaling_governor"))},
              {"turbo_disabled", or_null(first_line("/sys/devices/system/cpu/intel_pstate/no_turbo"))},
              {"megahertz", or_null(value_in("/proc/cpuinfo", "cpu MHz", ':'))},
              {"microcode", or_null(value_in("/proc/cpuinfo", "microcode", ':'))}};
    return json;
}

Json memory()
{
    std::istringstream total(value_in("/proc/meminfo", "MemTotal", ':'));
    std::uint64_t kibibytes = 0;
    total >> kibibytes;
    return {{"total_bytes", kibibytes << 10}, {"available_bytes", available_memory()}};
}

// Follows a library's symbolic links and returns the name of the file itself, which contains the version; empty if the
// library is not found.
std::string resolved(const std::string& library)
{
    std::error_code none;
    for (const char* folder :
         {"", "/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib64", "/usr/lib"}) {
        const fs::path path = fs::path(folder) / library;
        if (path.is_absolute() && fs::exists(path, none)) return fs::canonical(path, none).filename().string();
    }
    return {};
}

// Returns the drivers that are installed for the backends' loaders, and the drivers' libraries.
Json icds(const Registry& registry)
{
    Json found = Json::array();
    for (const auto& backend : registry.backends()) {
        for (const InstalledDriver& driver : backend->installed_drivers()) {
            found.push_back({{"api", driver.api},
                             {"file", fs::path(driver.file).filename().string()},
                             {"library", fs::path(driver.library).filename().string()},
                             {"resolved", or_null(resolved(driver.library))}});
            if (!driver.api_version.empty()) found.back()["api_version"] = driver.api_version;
        }
    }
    return found;
}

Json backends(const Registry& registry)
{
    Json found = Json::array();
    for (const auto& backend : registry.backends()) {
        const Listing listing = listing_of(*backend);
        Json devices = Json::array();
        for (const Device& device : listing.devices) {
            devices.push_back({{"name", device.name},
                               {"vendor", device.vendor},
                               {"driver", device.driver},
                               {"is_gpu", device.is_gpu}});
        }
        const std::string why = listing.unavailable + listing.failure;
        const BackendInfo info = backend->info();
        found.push_back({{"name", backend->name()},
                         {"title", info.title},
                         {"distribution", info.distribution},
                         {"role", name_of(info.role)},
                         {"unavailable", or_null(why)},
                         {"compiler", info.build.compiler},
                         {"flags_exact", info.build.exact},
                         {"flags_fast", info.build.fast},
                         {"devices", devices}});
    }
    return found;
}

}  // namespace

Json environment(const Registry& registry)
{
    utsname system{};
    uname(&system);
    return {{"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                                 fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())))},
            {"git", {{"revision", source_revision()}, {"dirty", sources_changed()}}},
            {"build",
             {{"type", MANDELMARCH_BUILD_TYPE},
              {"compiler", MANDELMARCH_CXX},
              {"flags", MANDELMARCH_CXX_FLAGS},
              {"version", project_version()}}},
            {"cpu", cpu()},
            {"memory", memory()},
            {"os",
             {{"name", or_null(value_in("/etc/os-release", "PRETTY_NAME", '='))},
              {"kernel", fmt::format("{} {}", system.sysname, system.release)},
              {"boot", or_null(first_line("/proc/sys/kernel/random/boot_id"))},
              {"architecture", system.machine}}},
            {"backends", backends(registry)},
            {"icds", icds(registry)},
            {"variables", recorded_variables()}};
}

}  // namespace mandelmarch::bench
