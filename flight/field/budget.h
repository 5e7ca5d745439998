// SPDX-License-Identifier: Apache-2.0
// A bound on the work of a search, so that no scene makes it run for ever.
#pragma once

namespace mandelmarch {

class Budget {
public:
    // Processor time from now on, of all of the program's threads together, in seconds: a search stays within it on a
    // busy machine, too.
    explicit Budget(double seconds);

    // Throws InputError once it is spent.
    void check() const;

private:
    double seconds_, start_;
};

}  // namespace mandelmarch
