// SPDX-License-Identifier: Apache-2.0
// The fault of a driver under test, which MANDELMARCH_FAULT names: a word of the driver's API, or "STAGE ACTION", for
// example `build abort`. Stages: load, list, build, launch, map, release. Actions: abort, exit, hang, garbage, speak
// (print a line twice and continue). MANDELMARCH_FAULT_AFTER: the number of calls that succeed before fails() is true.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace mandelmarch::drivers {

inline bool has_fault(std::string_view name)
{
    const char* fault = std::getenv("MANDELMARCH_FAULT");
    return fault != nullptr && name == fault;
}

// Counts the calls that the fault affects. Returns true if this call must fail.
inline bool fails(std::string_view name)
{
    static int calls = 0;
    if (!has_fault(name)) return false;
    const char* after = std::getenv("MANDELMARCH_FAULT_AFTER");
    return calls++ >= (after == nullptr ? 0 : std::atoi(after));
}

// Does the action that is selected for this stage, if any. Returns true if the stage must return garbage. Does not
// return if the action ends the process or hangs.
inline bool driver_faults(std::string_view stage)
{
    const auto has = [&](const char* action) { return has_fault(std::string(stage).append(" ").append(action)); };
    if (has("abort")) std::abort();
    if (has("exit")) std::exit(0);
    while (has("hang")) pause();
    if (has("speak")) std::fputs("the driver speaks\nthe driver speaks\n", stderr);
    return has("garbage");
}

// A device name with control characters.
inline constexpr std::string_view garbage_name = "junk\x1b[2J\n\x01 device";

}  // namespace mandelmarch::drivers
