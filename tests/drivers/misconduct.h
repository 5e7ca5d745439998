// SPDX-License-Identifier: Apache-2.0
// What a driver under test does instead of its work, as MANDELMARCH_MISCONDUCT says: "STAGE ACTION", `build abort` say.
// Stages: load, enumeration, build, launch, map, release. Actions: abort, crash, exit, leave (without the handlers of
// exit), hang, garbage, speak (print a line twice and go on).
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace mandelmarch::drivers {

inline bool asked(std::string_view stage, std::string_view action)
{
    const char* wanted = std::getenv("MANDELMARCH_MISCONDUCT");
    return wanted != nullptr && std::string(stage).append(" ").append(action) == wanted;
}

// True where the stage is to hand out garbage; comes back at all only then, or where another stage was asked for.
inline bool misconduct(std::string_view stage)
{
    if (asked(stage, "abort")) std::abort();
    if (asked(stage, "crash")) {
        // Some drivers' handlers let a signal that was only raised pass.
        volatile int* nothing = nullptr;
        *nothing = 0;
    }
    if (asked(stage, "exit")) std::exit(0);
    if (asked(stage, "leave")) _exit(0);
    while (asked(stage, "hang")) pause();
    if (asked(stage, "speak")) std::fputs("the driver speaks\nthe driver speaks\n", stderr);
    return asked(stage, "garbage");
}

// A name that writes over the screen.
inline constexpr const char* garbage_name = "junk\x1b[2J\n\x01 device";

}  // namespace mandelmarch::drivers
