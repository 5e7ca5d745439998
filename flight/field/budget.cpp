// SPDX-License-Identifier: Apache-2.0
#include "flight/field/budget.h"

#include <fmt/format.h>

#include <ctime>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

double processor_seconds()
{
    timespec spent{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
    return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

}  // namespace

Budget::Budget(double seconds) : seconds_(seconds), start_(processor_seconds()) {}

void Budget::check() const
{
    if (processor_seconds() - start_ <= seconds_) return;
    throw InputError(fmt::format(
        "no path within {:.0f} s of processor time: this shape's distances cost too much, expected fewer iterations, "
        "fewer frames or another shape (another seed does not help)",
        seconds_));
}

}  // namespace mandelmarch
