// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/interruption.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace mandelmarch::bench {
namespace {

// The state that the signal handler uses.
volatile std::sig_atomic_t recorded = 0;  // NOLINT
struct sigaction before_int {};           // NOLINT
struct sigaction before_term {};          // NOLINT

void restore()
{
    sigaction(SIGINT, &before_int, nullptr);
    sigaction(SIGTERM, &before_term, nullptr);
}

void record(int signal)
{
    recorded = signal;
    restore();
    constexpr std::string_view text = "bench: interrupted; what was measured is written after the current picture\n";
    static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
}

}  // namespace

Interruption::Interruption()
{
    struct sigaction action {};
    action.sa_handler = record;
    sigaction(SIGINT, &action, &before_int);
    sigaction(SIGTERM, &action, &before_term);
}

Interruption::~Interruption() { restore(); }

int interrupted() { return recorded; }

}  // namespace mandelmarch::bench
