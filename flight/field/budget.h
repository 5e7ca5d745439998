// SPDX-License-Identifier: Apache-2.0
// A bound on the work of a search, so that no scene makes it run for ever.
#pragma once

namespace mandelmarch {

class Budget {
public:
    // Seconds of processor time from now on, summed over the program's threads, so that a busy machine leaves a search
    // the same work.
    explicit Budget(double seconds);

    // Throws InputError once the budget is spent.
    void check() const;

private:
    double seconds_, start_;
};

}  // namespace mandelmarch
