#include "core/base/error.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "core/base/console.h"
#include "core/base/text.h"

namespace mandelmarch {

double device_timeout()
{
    constexpr double usual = 300;
    const char* text = std::getenv("MANDELMARCH_DEVICE_TIMEOUT");
    const double seconds = text == nullptr ? usual : std::strtod(text, nullptr);
    return seconds > 0 ? seconds : usual;
}

int run_program(const char* program, int (*body)(int, char**), int argc, char** argv)
{
    // A reader that goes away and a file size limit become errors of the write that meets them.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
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
