// SPDX-License-Identifier: Apache-2.0
// A time limit for searches, so that every search ends.
#pragma once

namespace mandelmarch {

class Budget {
public:
    // `seconds`: processor time from now on, summed over the program's threads. Other load on the machine does not
    // shorten a search.
    explicit Budget(double seconds);

    // Throws InputError once the budget is spent.
    void check() const;

private:
    double seconds_, start_;
};

}  // namespace mandelmarch
