#include "bench/launches.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "bench/report.h"
#include "core/base/error.h"

extern char** environ;  // NOLINT: POSIX leaves its declaration to the program

namespace mandelmarch::bench {
namespace {

// A file that goes when this does.
class TemporaryFile {
public:
    TemporaryFile() : path_((std::filesystem::temp_directory_path() / "mandelmarch-bench-XXXXXX").string())
    {
        const int descriptor = mkstemp(path_.data());
        if (descriptor < 0) throw Error(fmt::format("{}: {}", path_, std::strerror(errno)));
        close(descriptor);
    }
    ~TemporaryFile() { unlink(path_.c_str()); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

int run(const std::vector<std::string>& arguments)
{
    std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    if (const int code = posix_spawn(&child, program.c_str(), nullptr, nullptr, argv.data(), environ); code != 0) {
        throw Error(fmt::format("bench: a further launch does not start: {}", std::strerror(code)));
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) throw Error(fmt::format("bench: waiting for a launch: {}", std::strerror(errno)));
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
            same->proof.fine = same->proof.fine && (row.proof.fine || !row.unavailable.empty());
        }
        for (const Peak& peak : one.peaks) {
            const auto same = std::ranges::find_if(all.peaks, [&](const Peak& p) {
                return p.platform == peak.platform && p.backend == peak.backend && p.device == peak.device &&
                       p.precision == peak.precision;
            });
            if (same == all.peaks.end()) {
                all.peaks.push_back(peak);
            } else {
                same->rate = std::max(same->rate, peak.rate);
            }
        }
        for (StageTime& time : one.stages) {
            for (StageTime& to : all.stages) {
                if (to.fractal == time.fractal && to.precision == time.precision && to.mode == time.mode &&
                    to.stage == time.stage) {
                    to.seconds.insert(to.seconds.end(), time.seconds.begin(), time.seconds.end());
                }
            }
        }
        for (const std::string& warning : one.warnings)
            all.warnings.push_back(fmt::format("launch {}: {}", i, warning));
    }
    all.launches = static_cast<int>(results.size());
    return all;
}

Result launch_again(const std::vector<std::string>& arguments, int launch)
{
    const TemporaryFile file;
    std::vector<std::string> words = arguments;
    for (const std::string& word : {std::string("--launch"), std::to_string(launch), std::string("--quiet"),
                                    std::string("--json"), file.path()}) {
        words.push_back(word);
    }
    const int code = run(words);
    // A mismatch leaves a result, too; anything else does not.
    if (code != exit_fine && code != exit_failure)
        throw Error(fmt::format("bench: launch {} ended with {}", launch, code));
    std::error_code none;
    if (std::filesystem::file_size(file.path(), none) == 0) throw Error(fmt::format("bench: launch {} failed", launch));
    return read_result(file.path());
}

}  // namespace mandelmarch::bench
