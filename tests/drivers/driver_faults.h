// SPDX-License-Identifier: Apache-2.0
// Faults of a driver under test. MANDELMARCH_MISCONDUCT selects a fault as "STAGE ACTION", for example `build abort`.
// Stages: load, enumeration, build, launch, map, release. Actions: abort, crash, exit, hang, garbage, speak (print a
// line twice and continue).
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

// Does the action that is selected for this stage, if any. Returns true if the stage must return garbage. Does not
// return if the action ends the process or hangs.
inline bool driver_faults(std::string_view stage)
{
    if (asked(stage, "abort")) std::abort();
    if (asked(stage, "crash")) {
        // Accesses invalid memory, because the signal handlers of some drivers ignore a signal that was only raised.
        volatile int* nothing = nullptr;
        *nothing = 0;
    }
    if (asked(stage, "exit")) std::exit(0);
    while (asked(stage, "hang")) pause();
    if (asked(stage, "speak")) std::fputs("the driver speaks\nthe driver speaks\n", stderr);
    return asked(stage, "garbage");
}

// A device name with control characters.
inline constexpr const char* garbage_name = "junk\x1b[2J\n\x01 device";

}  // namespace mandelmarch::drivers
