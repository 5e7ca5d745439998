// SPDX-License-Identifier: Apache-2.0
#include "core/base/temporary_path.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <vector>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};

struct Name {
    std::string path;
    pid_t owner;  // the process that removes the file; a forked process inherits the name, but does not own the file

    bool operator==(const Name&) const = default;
};

// The names in use. They are global, because a signal handler needs them.
struct Names {
    std::vector<Name> all;
    std::mutex mutex;
    std::atomic<int> changing = 0;
    std::atomic<bool> ending = false;
};
std::atomic<Names*> names = nullptr;  // NOLINT: see above

void wait_a_millisecond()
{
    const timespec millisecond{0, 1'000'000};
    nanosleep(&millisecond, nullptr);
}

// The signal handler. Removes the files, then raises the signal again with its default action.
void remove_files(int signal)
{
    Names& known = *names.load();
    known.ending = true;
    // Waits until a thread inside a Change has left it; no other thread can enter one now. Waits at most one second, in
    // case that thread is blocked in a file system.
    for (int waits = 0; known.changing > 0 && waits < 1000; ++waits) wait_a_millisecond();
    if (known.changing == 0) {
        for (const Name& name : known.all) {
            if (name.owner == getpid()) unlink(name.path.c_str());
        }
    }
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(signal, &usual, nullptr);
    raise(signal);
}

Names& installed()
{
    static std::once_flag once;
    std::call_once(once, [] {
        names = new Names;  // never deleted, because signals may arrive until the process ends
        struct sigaction action {};
        action.sa_handler = remove_files;
        sigfillset(&action.sa_mask);
        for (const int signal : ending_signals) {
            struct sigaction old {};
            sigaction(signal, nullptr, &old);
            if ((old.sa_flags & SA_SIGINFO) == 0 && old.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
        }
    });
    return *names.load();
}

// While a Change exists, its thread may change the list of names and create, rename or remove the files. It blocks the
// signals in its thread; the handler waits if it runs in another thread.
class Change {
public:
    Change() : names_(installed())
    {
        sigset_t ending{};
        sigemptyset(&ending);
        for (const int signal : ending_signals) sigaddset(&ending, signal);
        pthread_sigmask(SIG_BLOCK, &ending, &old_);
        names_.mutex.lock();
        ++names_.changing;
        if (!names_.ending) return;
        --names_.changing;
        for (;;) pause();  // the process is about to end
    }
    ~Change()
    {
        --names_.changing;
        names_.mutex.unlock();
        pthread_sigmask(SIG_SETMASK, &old_, nullptr);
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;

    void add(const std::string& path) { names_.all.push_back({path, getpid()}); }
    // Removes a name from the list. Returns false if another process created the file.
    bool forget(const std::string& path) { return std::erase(names_.all, Name{path, getpid()}) > 0; }

private:
    Names& names_;
    sigset_t old_{};
};

}  // namespace

TemporaryPath::TemporaryPath(std::string path) : path_(std::move(path)) { Change().add(path_); }

TemporaryPath::TemporaryPath(const std::string& prefix, int& descriptor) : path_(prefix + "XXXXXX")
{
    Change change;
    descriptor = mkostemp(path_.data(), O_CLOEXEC);
    if (descriptor < 0) throw Error(fmt::format("cannot create {}: {}", prefix + "XXXXXX", std::strerror(errno)));
    change.add(path_);
}

TemporaryPath::~TemporaryPath()
{
    if (path_.empty()) return;
    Change change;
    if (change.forget(path_)) unlink(path_.c_str());
}

bool TemporaryPath::rename_to(const std::string& target)
{
    Change change;
    if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
    change.forget(path_);
    path_.clear();
    return true;
}

}  // namespace mandelmarch
