// SPDX-License-Identifier: Apache-2.0
// The implementation of Ranks for a single process.
#pragma once

#include <cstdlib>

#include "flight/film/ranks.h"

namespace mandelmarch {

class OneRank : public Ranks {
public:
    int rank() const override { return 0; }
    int size() const override { return 1; }
    int local_rank() const override { return 0; }
    int local_size() const override { return 1; }
    std::string share(const std::string& text) override { return text; }
    void each(std::size_t count, const std::function<void(std::size_t)>& body,
              const std::function<void(std::size_t)>& done) override
    {
        for (std::size_t i = 0; i < count; ++i) {
            body(i);
            done(i);
        }
    }
    void abort(int code) override { std::exit(code); }
};

std::unique_ptr<Ranks> one_rank();

// Returns true if environment variables show that mpirun, or srun with MPI, started this process.
bool started_by_mpi();

}  // namespace mandelmarch
