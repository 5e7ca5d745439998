// SPDX-License-Identifier: Apache-2.0
// Progress on stderr: a bar on a terminal, else a line for each new phase.
#pragma once

#include <memory>
#include <string>

#include "bench/measure/runner.h"
#include "core/os/progress_bar.h"
#include "core/os/stopwatch.h"
#include "core/text/console.h"

namespace mandelmarch::bench {

class Display {
public:
    explicit Display(const char* program = "bench") : program_(program) {}

    // Shows a step. `since`: start of its phase, from which the remaining time is estimated.
    void show(const Step& step, Clock::time_point since = Clock::now())
    {
        if (step.what != what_) {
            what_ = step.what;
            bar_.reset();
            bar_ = std::make_unique<ProgressBar>(what_, ProgressOptions{.start = since});
            if (!bar_->on_terminal()) say("{}: {}\n", program_, what_);
        }
        bar_->show(step.share, step.detail);
    }

    void finish() { bar_.reset(); }

private:
    const char* program_;
    std::string what_;
    std::unique_ptr<ProgressBar> bar_;
};

}  // namespace mandelmarch::bench
