// SPDX-License-Identifier: Apache-2.0
// The processes that render one film: the ranks of an MPI program, or one process.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace mandelmarch {

class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    // This rank's index among those on the same machine, and their number.
    virtual int local_rank() const = 0;
    virtual int local_size() const = 0;

    // Broadcasts rank 0's text: returns it on every rank. All ranks must call it.
    virtual std::string share(const std::string& text) = 0;

    // Distributes the numbers 0 to count - 1 among the ranks, in order, each when a rank is free: calls body(number) on
    // this rank until none is left, and returns when all ranks are done. Calls done(number) on rank 0 after a number's
    // body has returned.
    virtual void each(std::size_t count, const std::function<void(std::size_t)>& body,
                      const std::function<void(std::size_t)>& done) = 0;

    // Ends every rank with an exit code.
    virtual void abort(int code) = 0;
};

// Returns the ranks of this MPI program, or one process if it was not started by mpirun. Throws Unavailable if it was
// started by mpirun but built without MPI.
std::unique_ptr<Ranks> make_ranks();

}  // namespace mandelmarch
