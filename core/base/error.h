// SPDX-License-Identifier: Apache-2.0
// Exceptions and exit codes of the programs.
#pragma once

#include <stdexcept>
#include <string>

namespace mandelmarch {

enum ExitCode : int {
    exit_success = 0,
    exit_failure = 1,      // a mismatch, or a failure while running (such as a full disk)
    exit_usage = 2,        // wrong arguments or a bad input file
    exit_unavailable = 77  // the backend or its device is not available
};

// A failure while running: exit_failure.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Unusable input: exit_usage. The message says where, what is wrong and what was expected.
class InputError : public Error {
public:
    using Error::Error;
};

// A backend or device is not available or does not support a request: exit_unavailable.
class Unavailable : public Error {
public:
    using Error::Error;
};

// A device that does not respond: exit_failure. Its driver may never return, so the program exits without cleaning it
// up.
class DeviceHung : public Error {
public:
    using Error::Error;
};

// The caller cancelled a picture (core/render/backend.h, Progress): exit_failure.
class Cancelled : public Error {
public:
    Cancelled() : Error("the drawing was cancelled") {}
};

// Returns the seconds allowed for one pass over a band of a picture: MANDELMARCH_DEVICE_TIMEOUT in the environment, or
// 300 if unset or empty. Throws InputError if it is not a number from 0.001 to 1e6.
double device_timeout();

// Runs `body`, the whole program, and returns its exit code. Prints an exception as a line `program: message` on
// stderr; an InputError that begins with a place (`file:line:`) is printed without the program's name.
int run_program(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace mandelmarch
