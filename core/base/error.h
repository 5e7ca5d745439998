// SPDX-License-Identifier: Apache-2.0
// The three ways in which a program of this project fails, each with its exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace mandelmarch {

// Exit codes of every program.
enum ExitCode : int {
    exit_fine = 0,
    exit_failure = 1,      // a mismatch, or something failed while running (a full disk, say)
    exit_usage = 2,        // wrong arguments or a bad input file
    exit_unavailable = 77  // the backend or its device is not there
};

// Something failed while running: exit_failure.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The user's input cannot be used: exit_usage. The text says where, what is wrong and what was expected.
class InputError : public Error {
public:
    using Error::Error;
};

// A backend or device is not there or cannot do what is asked: exit_unavailable.
class Unavailable : public Error {
public:
    using Error::Error;
};

// A device that does not answer: exit_failure. Its driver may never return, so the program ends without tidying it up.
class DeviceHung : public Error {
public:
    using Error::Error;
};

// Who asked for a picture no longer wants it (core/render/backend.h, Progress): exit_failure.
class Cancelled : public Error {
public:
    Cancelled() : Error("the drawing was cancelled") {}
};

// Seconds that a device may take for one pass over one band of a picture: MANDELMARCH_DEVICE_TIMEOUT in the
// environment, or 300. Throws InputError where that is no number from 0.001 to 1e6; empty counts as not set.
double device_timeout();

// Runs `body`, a program's whole work, and turns what it throws into one line on stderr, `program: text`, and the exit
// code. An InputError's text stands alone where it begins with a place (`file:line:`).
int run_program(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace mandelmarch
