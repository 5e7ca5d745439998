// SPDX-License-Identifier: Apache-2.0
// Several processes that make one film together: the ranks of an MPI program, or one process alone.
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
    // This rank's number among those on the same machine, and how many these are.
    virtual int local_rank() const = 0;
    virtual int local_size() const = 0;

    // Rank 0's text, for every rank.
    virtual std::string share(const std::string& text) = 0;

    // Hands out the numbers 0 to count - 1, each to one rank, in order: calls body(number) on this rank until none is
    // left, and returns when all ranks are done. Ranks that are faster get more. `done` is called on rank 0 with a
    // number when its body has returned.
    virtual void each(std::size_t count, const std::function<void(std::size_t)>& body,
                      const std::function<void(std::size_t)>& done) = 0;

    // Ends every rank with an exit code.
    virtual void abort(int code) = 0;
};

// The ranks that mpirun started, where this program was built with MPI and started by it; else one process alone.
// Throws Unavailable where mpirun started several that cannot work together, as the program was built without MPI.
std::unique_ptr<Ranks> make_ranks();

}  // namespace mandelmarch
