// SPDX-License-Identifier: Apache-2.0
#include "core/os/cores.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/os/control_group.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"

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

// Returns the list in an environment variable: its words in small letters, without the blanks around them.
std::vector<std::string> list_in(VariableName variable)
{
    const std::string text = environment_variable(variable);
    std::vector<std::string> words;
    for (const std::string_view part : split(text, ',')) {
        std::string& word = words.emplace_back(trimmed(part));
        std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    }
    return words;
}

// Returns the first number of the list in an environment variable; nullopt if a word of the list is not a positive
// integer.
std::optional<int> first_number(VariableName variable)
{
    std::optional<int> first;
    for (const std::string& word : list_in(variable)) {
        const auto number = parse_whole(word);
        if (!number || *number < 1) return std::nullopt;
        if (!first) first = static_cast<int>(std::min<long long>(*number, std::numeric_limits<int>::max()));
    }
    return first;
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
    const std::optional<int> asked = first_number("OMP_NUM_THREADS");
    if (asked && *asked > most_threads) {
        throw InputError(fmt::format("OMP_NUM_THREADS: '{}' given, expected 1 to {}",
                                     environment_variable("OMP_NUM_THREADS"), most_threads));
    }
    return {.machine = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN))),
            .given = cores_given(),
            .quota = processor_quota(root),
            .asked = asked,
            .limit = first_number("OMP_THREAD_LIMIT")};
}

int usable_threads() { return cores().threads(); }

std::string binding()
{
    const std::vector<std::string> policy = list_in("OMP_PROC_BIND");
    if (policy == std::vector<std::string>{"false"}) return {};
    const bool heeded = policy == std::vector<std::string>{"true"} || std::ranges::all_of(policy, [](const auto& word) {
                            return word == "master" || word == "primary" || word == "close" || word == "spread";
                        });
    if (heeded) return "OMP_PROC_BIND=" + environment_variable("OMP_PROC_BIND");
    for (const VariableName name : {VariableName("OMP_PLACES"), VariableName("GOMP_CPU_AFFINITY")}) {
        const std::string text = environment_variable(name);
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
