// SPDX-License-Identifier: Apache-2.0
#include "flight/film/ranks_one.h"

#include <cstdlib>
#include <string_view>

#include "core/base/error.h"

namespace mandelmarch {

bool started_by_mpi()
{
    // Set by Open MPI, by MPICH and its derivatives, and by PMIx (Slurm).
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
        const char* value = std::getenv(name);
        if (value != nullptr && *value != '\0') return true;
    }
    return false;
}

std::unique_ptr<Ranks> one_rank() { return std::make_unique<OneRank>(); }

#ifndef MANDELMARCH_HAS_MPI
std::unique_ptr<Ranks> make_ranks()
{
    if (started_by_mpi()) {
        throw Unavailable(
            "this program was built without MPI and cannot share work, expected no mpirun or a build with MPI");
    }
    return one_rank();
}
#endif

}  // namespace mandelmarch
