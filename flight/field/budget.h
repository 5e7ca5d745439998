// SPDX-License-Identifier: Apache-2.0
// A time limit for searches, so that every search ends.
#pragma once

namespace mandelmarch {

class Budget {
public:
    // `seconds`: limit on the processor time of all threads of the program, measured from the construction. Other load
    // on the machine therefore does not shorten a search.
    explicit Budget(double seconds);

    // Throws InputError if the time is used up.
    void check() const;

private:
    double seconds_, start_;
};

}  // namespace mandelmarch
