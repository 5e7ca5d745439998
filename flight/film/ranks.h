// SPDX-License-Identifier: Apache-2.0
// The processes that render a film together: the ranks of an MPI program, or a single process.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

namespace mandelmarch {

// This class is a single process; another one implements MPI's ranks.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int rank() const { return 0; }
    virtual int size() const { return 1; }
    // The index of this rank among the ranks on the same machine, and the number of those ranks.
    virtual int local_rank() const { return 0; }
    virtual int local_size() const { return 1; }

    // Returns rank 0's text on every rank (a broadcast). All ranks must call this function.
    virtual std::string share(const std::string& text) { return text; }

    // Distributes the numbers 0 to count - 1 among the ranks: each rank takes the next number when it is free and calls
    // body(number). After that, done(number) is called on rank 0. Returns when the work of all ranks is done. All ranks
    // must call this function.
    virtual void each(std::size_t count, const std::function<void(std::size_t)>& body,
                      const std::function<void(std::size_t)>& done);

    // Ends every rank with an exit code.
    virtual void abort(int code) { std::exit(code); }
};

// Returns the ranks of this MPI program, or a single rank if the program was not started by mpirun. Throws Unavailable
// if it was started by mpirun but built without MPI.
std::unique_ptr<Ranks> make_ranks();

// Throws InputError if the environment says that several processes were started together, but they do not find each
// other: each of them would make the whole film.
void refuse_singletons(const Ranks& ranks);

// Returns true if environment variables show that mpirun, or srun with MPI, started this process.
bool started_by_mpi();

}  // namespace mandelmarch
