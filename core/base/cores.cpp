// SPDX-License-Identifier: Apache-2.0
#include "core/base/cores.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "core/base/control_group.h"
#include "core/base/environment.h"

namespace mandelmarch {
namespace {

// The affinity that the process started with, one bit per core. It is recorded before main() and before the
// constructors of shared libraries run, because the constructor of OpenMP's library binds the first thread to a core.
struct Mask {
    unsigned long bits[128] = {};  // room for 8192 cores
    long bytes = 0;                // number of bytes that the operating system wrote; 0 or less: unknown
};
constinit Mask given;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): set before constructors run

// Sanitizers must not instrument this function, because it runs before they are initialised.
__attribute__((no_sanitize("address", "thread", "undefined"))) void note_affinity()
{
    given.bytes = syscall(SYS_sched_getaffinity, 0, sizeof given.bits, given.bits);
}

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): the section must be writable
__attribute__((section(".preinit_array"), used)) void (*before_libraries)() = note_affinity;

int cores_given()
{
    if (given.bytes <= 0) note_affinity();
    const auto words = static_cast<std::size_t>(std::max(0L, given.bytes)) / sizeof given.bits[0];
    int count = 0;
    for (const unsigned long word : std::span(given.bits).first(words)) count += std::popcount(word);
    return std::max(1, count);
}

// Returns the first number of the list in an environment variable; nullopt if the variable is not set or the number is
// not positive.
std::optional<int> first_number(VariableName variable)
{
    const std::string text = environment_variable(variable);
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (end == text.c_str() || value < 1) return std::nullopt;
    return static_cast<int>(std::min(value, 1L << 20));
}

}  // namespace

int Cores::threads() const
{
    int threads = asked.value_or(given);
    if (!asked && quota) threads = std::min(threads, static_cast<int>(std::ceil(*quota)));
    return std::max(1, std::min(threads, limit.value_or(threads)));
}

Cores cores(const std::string& root)
{
    return {.machine = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN))),
            .given = cores_given(),
            .quota = processor_quota(root),
            .asked = first_number("OMP_NUM_THREADS"),
            .limit = first_number("OMP_THREAD_LIMIT")};
}

int usable_threads() { return cores().threads(); }

std::string binding()
{
    for (const VariableName name :
         {VariableName("OMP_PROC_BIND"), VariableName("OMP_PLACES"), VariableName("GOMP_CPU_AFFINITY")}) {
        const std::string text = environment_variable(name);
        if (text == "false" || text == "FALSE") return {};
        if (!text.empty()) return fmt::format("{}={}", name.text, text);
    }
    return {};
}

void limit_driver_threads(const char* name)
{
    const Cores mine = cores();
    if (mine.threads() < mine.machine) setenv(name, fmt::format("{}", mine.threads()).c_str(), 0);
}

int threads_named(const std::string& beginning)
{
    std::set<std::string> names;
    std::error_code none;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", none)) {
        std::ifstream file(thread.path() / "comm");
        std::string name;
        std::getline(file, name);
        if (name.starts_with(beginning)) names.insert(name);
    }
    return static_cast<int>(names.size());
}

void restore_affinity()
{
    if (given.bytes > 0) syscall(SYS_sched_setaffinity, 0, static_cast<std::size_t>(given.bytes), given.bits);
}

}  // namespace mandelmarch
