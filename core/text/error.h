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

// A failure while running. Exit code: exit_failure.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Unusable input. Exit code: exit_usage. The message names the place, the fault, and what was expected.
class InputError : public Error {
public:
    using Error::Error;
};

// A backend or device is not available or does not support a request. Exit code: exit_unavailable.
class Unavailable : public Error {
public:
    using Error::Error;
};

// A device does not respond. Exit code: exit_failure. Its driver may never return, so the program exits without
// releasing the device.
class DeviceHung : public Error {
public:
    using Error::Error;
};

// The caller has cancelled a picture (Progress in core/render/backend.h). Exit code: exit_failure.
class Cancelled : public Error {
public:
    Cancelled() : Error("the drawing was cancelled") {}
};

}  // namespace mandelmarch
