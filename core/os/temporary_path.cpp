// SPDX-License-Identifier: Apache-2.0
#include "core/os/temporary_path.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr pid_t nobody = 0;
constexpr pid_t in_change = -1;

struct Name {
    std::atomic<pid_t> owner = nobody;  // the process that removes the file; a process forked from it must not
    pid_t group;                        // a process group to kill; 0: the name is a file's
    std::array<char, PATH_MAX> path;
};

// The names in use. They are global, because a signal handler has no other access to them. If no slot is free for a
// name, its file or process group remains after a signal.
std::array<Name, 64> names;  // NOLINT: see above

// Removes a file, or a folder with its contents, as far as possible. `parent`: the descriptor of the folder that `name`
// starts from. A signal handler may call this function.
void remove_tree(int parent, const char* name)  // NOLINT(misc-no-recursion): as deep as the folders
{
    if (unlinkat(parent, name, 0) == 0 || (errno != EISDIR && errno != EPERM)) return;
    // It is a folder. Other programs may have removed its owner's rights.
    fchmodat(parent, name, S_IRWXU, 0);
    const int folder = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    alignas(dirent64) std::array<char, 2048> entries;
    for (long size = 1; size > 0;) {
        size = syscall(SYS_getdents64, folder, entries.data(), entries.size());  // readdir() allocates memory
        for (long at = 0; at < size;) {
            const auto* const entry = static_cast<const dirent64*>(static_cast<const void*>(entries.data() + at));
            const char* const inner = static_cast<const char*>(entry->d_name);
            if (std::strcmp(inner, ".") != 0 && std::strcmp(inner, "..") != 0) remove_tree(folder, inner);
            at += entry->d_reclen;
        }
    }
    close(folder);
    unlinkat(parent, name, AT_REMOVEDIR);
}

// Kills this process's children, if those that lose their parents become children of this process. A signal handler may
// call this function.
void kill_adopted()
{
    int adopts = 0;
    if (prctl(PR_GET_CHILD_SUBREAPER, &adopts) != 0 || adopts == 0) return;
    // Adopted children belong to the main thread, whose number is the process's.
    std::array<char, 16> digits{};
    std::size_t first = digits.size() - 1;
    for (pid_t rest = getpid(); rest > 0; rest /= 10) digits[--first] = static_cast<char>('0' + rest % 10);
    std::array<char, 64> path{"/proc/self/task/"};
    std::strcat(std::strcat(path.data(), &digits[first]), "/children");
    constexpr int most_generations = 64;
    for (int generation = 0; generation < most_generations; ++generation) {
        const int list = open(path.data(), O_RDONLY | O_CLOEXEC);
        std::array<char, 4096> text{};
        const ssize_t size = list < 0 ? 0 : read(list, text.data(), text.size() - 1);
        close(list);
        pid_t child = 0;
        for (ssize_t i = 0; i < size; ++i) {
            if (text[static_cast<std::size_t>(i)] != ' ') {
                child = 10 * child + (text[static_cast<std::size_t>(i)] - '0');
                continue;
            }
            kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
            child = 0;
        }
        if (size <= 0) return;
    }
}

// The signal handler. Kills the process groups, removes the files, then raises the signal again with its default
// action.
void remove_files(int signal)
{
    for (const Name& name : names) {
        if (name.owner == getpid() && name.group != 0) kill(-name.group, SIGKILL);
    }
    kill_adopted();
    for (const Name& name : names) {
        if (name.owner == getpid() && name.group == 0) remove_tree(AT_FDCWD, name.path.data());
    }
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(signal, &usual, nullptr);
    raise(signal);
}

void install()
{
    struct sigaction action {};
    action.sa_handler = remove_files;
    sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if ((old.sa_flags & SA_SIGINFO) == 0 && old.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
    }
}

// Returns the name's slot; names.size() if none is free or the path is too long.
std::size_t add(const std::string& path, pid_t group = 0)
{
    install();  // each time, because a library may have restored the default action
    for (std::size_t slot = 0; slot < names.size() && path.size() < PATH_MAX; ++slot) {
        Name& name = names.at(slot);
        pid_t owner = nobody;
        if (!name.owner.compare_exchange_strong(owner, in_change)) continue;
        std::memcpy(name.path.data(), path.c_str(), path.size() + 1);
        name.group = group;
        name.owner = getpid();
        return slot;
    }
    return names.size();
}

void free_slot(std::size_t slot)
{
    if (slot < names.size()) names.at(slot).owner = nobody;
}

}  // namespace

TemporaryPath::TemporaryPath(std::string path) : path_(std::move(path)), owner_(getpid()), slot_(add(path_)) {}

TemporaryPath::TemporaryPath(const std::string& prefix, int& descriptor) : owner_(getpid())
{
    do {
        path_ = fmt::format("{}{:08x}", prefix, std::random_device()());
        slot_ = add(path_);  // before the file exists, so that no signal can leave the file behind
        descriptor = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
        if (descriptor < 0) free_slot(slot_);
    } while (descriptor < 0 && errno == EEXIST);
    if (descriptor < 0) throw Error(fmt::format("cannot create {}: {}", path_, std::strerror(errno)));
}

TemporaryPath::~TemporaryPath()
{
    if (path_.empty() || owner_ != getpid()) return;
    remove_tree(AT_FDCWD, path_.c_str());
    free_slot(slot_);
}

bool TemporaryPath::rename_to(const std::string& target)
{
    if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
    keep();
    return true;
}

void TemporaryPath::keep()
{
    free_slot(std::exchange(slot_, names.size()));
    path_.clear();
}

KilledGroup::KilledGroup(pid_t group) : slot_(add({}, group)) {}

KilledGroup::~KilledGroup() { free_slot(slot_); }

}  // namespace mandelmarch
