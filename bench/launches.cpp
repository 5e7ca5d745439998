// SPDX-License-Identifier: Apache-2.0
#include "bench/launches.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "bench/report.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/text.h"

extern char** environ;  // NOLINT: POSIX requires the program to declare it

namespace mandelmarch::bench {
namespace {

// An anonymous file in memory. It is deleted when its descriptors are closed, at the latest when the processes end.
class MemoryFile {
public:
    MemoryFile() : descriptor_(memfd_create("launch", MFD_CLOEXEC))
    {
        if (descriptor_ < 0) throw Error(fmt::format("a file in memory: {}", std::strerror(errno)));
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int descriptor() const { return descriptor_; }

    std::string text() const
    {
        std::string text;
        char block[1 << 16];
        for (;;) {
            const ssize_t got = pread(descriptor_, block, sizeof(block), static_cast<off_t>(text.size()));
            if (got <= 0) return text;
            text.append(block, static_cast<std::size_t>(got));
        }
    }

private:
    int descriptor_;
};

// Starts this program again, with its standard output in `output`. Returns the exit code, or 128 + the signal's number.
int run(const std::vector<std::string>& arguments, int output)
{
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> words{program_invocation_name};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    pid_t child = 0;
    const int code = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0) throw Error(fmt::format("does not start: {}", std::strerror(code)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw Error(fmt::format("cannot be waited for: {}", std::strerror(errno)));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Result merged(std::vector<Result> results)
{
    Result all = std::move(results.front());
    for (std::size_t i = 1; i < results.size(); ++i) {
        Result& one = results[i];
        for (Row& row : one.rows) {
            const auto same = std::ranges::find_if(all.rows, [&](const Row& r) { return r.name() == row.name(); });
            if (same == all.rows.end()) {
                all.rows.push_back(std::move(row));
                continue;
            }
            same->samples.insert(same->samples.end(), row.samples.begin(), row.samples.end());
            if (same->failure.empty()) same->failure = row.failure;
            same->proof.passed = same->proof.passed && (row.proof.passed || !row.unavailable.empty());
        }
        raise_peaks(all.peaks, one.peaks);
        for (StageTime& time : one.stages) {
            for (StageTime& to : all.stages) {
                if (to.fractal == time.fractal && to.precision == time.precision && to.mode == time.mode &&
                    to.stage == time.stage) {
                    to.seconds.insert(to.seconds.end(), time.seconds.begin(), time.seconds.end());
                }
            }
        }
        all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
    }
    all.launches = static_cast<int>(results.size());
    return all;
}

Result with_further_launches(Result first, int count, const Run& launch)
{
    std::vector<Result> results{std::move(first)};
    std::vector<std::string> lost;
    for (int number = 1; number < count; ++number) {
        try {
            results.push_back(launch(number));
            for (std::string& warning : results.back().warnings)
                warning = fmt::format("launch {}: {}", number, warning);
        } catch (const std::exception& error) {
            lost.push_back(fmt::format("launch {} {}", number, error.what()));
            say("bench: {}, the other launches are kept\n", printable(lost.back()));
        }
    }
    Result all = merged(std::move(results));
    all.warnings.insert(all.warnings.end(), lost.begin(), lost.end());
    return all;
}

Result launch_again(const std::vector<std::string>& arguments, int launch)
{
    const MemoryFile file;
    std::vector<std::string> words = arguments;
    for (const char* word : {"--quiet", "--json", "-", "--launch"}) words.emplace_back(word);
    words.push_back(std::to_string(launch));
    const int code = run(words, file.descriptor());
    // bench leaves a result with these two exit codes only (failure: a wrong picture).
    if (code != exit_success && code != exit_failure) throw Error(fmt::format("ended with {}", code));
    const std::string text = file.text();
    if (text.empty()) throw Error(fmt::format("ended with {} and left no result", code));
    try {
        return parse_result(text, "its result");
    } catch (const InputError& error) {
        throw Error(fmt::format("ended with {} and left no whole result: {}", code, error.what()));
    }
}

}  // namespace mandelmarch::bench
