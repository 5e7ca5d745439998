// SPDX-License-Identifier: Apache-2.0
#include "core/os/program.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "core/os/cores.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {

namespace {

// Opens /dev/null in place of each standard descriptor that is closed, so that no file opened later receives its
// number. Opens it with the wrong access mode on purpose, so that reads from stdin and writes to stdout and stderr
// still fail.
void hold_standard_descriptors()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // open() uses the lowest free number, which is `descriptor`.
        static_cast<void>(open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
}

}  // namespace

int run_program(const char* program, const std::function<int(int, char**)>& body, int argc, char** argv)
{
    hold_standard_descriptors();
    restore_affinity();
    // While these signals are ignored, writes to closed pipes or beyond a file size limit return errors.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // A parent may have ignored it. The system would then not report how child processes end.
    std::signal(SIGCHLD, SIG_DFL);
    const auto complain = [&](const std::exception& error) { say("{}: {}\n", program, printable(error.what())); };
    try {
        const int code = body(argc, argv);
        flush_stdout();
        return code;
    } catch (const InputError& error) {
        say("{}\n", printable(error.what()));
        return exit_usage;
    } catch (const Unavailable& error) {
        complain(error);
        return exit_unavailable;
    } catch (const DeviceHung& error) {
        complain(error);
        std::fflush(nullptr);
        std::_Exit(exit_failure);
    } catch (const std::bad_alloc&) {
        say("{}: out of memory\n", program);
    } catch (const std::exception& error) {
        complain(error);
    }
    return exit_failure;
}

}  // namespace mandelmarch
