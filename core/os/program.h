// SPDX-License-Identifier: Apache-2.0
// The frame of every program's main().
#pragma once

#include <functional>

namespace mandelmarch {

// Runs `body`, which is the whole program, and returns its exit code. Catches its exceptions and prints them to stderr,
// as `program: message`. The message of an InputError is printed alone, because it begins with a place (`file:line:`).
int run_program(const char* program, const std::function<int(int, char**)>& body, int argc, char** argv);

}  // namespace mandelmarch
