#include "core/base/error.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

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
    try {
        return body(argc, argv);
    } catch (const InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return exit_usage;
    } catch (const Unavailable& error) {
        std::fprintf(stderr, "%s: %s\n", program, error.what());
        return exit_unavailable;
    } catch (const DeviceHung& error) {
        std::fprintf(stderr, "%s: %s\n", program, error.what());
        std::fflush(nullptr);
        std::_Exit(exit_failure);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: out of memory\n", program);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", program, error.what());
    }
    return exit_failure;
}

}  // namespace mandelmarch
