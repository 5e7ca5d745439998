// SPDX-License-Identifier: Apache-2.0
// A single process as Ranks.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"
#include "flight/film/ranks.h"

namespace mandelmarch {

void Ranks::each(std::size_t count, const std::function<void(std::size_t)>& body,
                 const std::function<void(std::size_t)>& done)
{
    for (std::size_t i = 0; i < count; ++i) {
        body(i);
        done(i);
    }
}

bool started_by_mpi()
{
    // Set by Open MPI, by MPICH and its derivatives, and by PMIx (Slurm).
    return !environment_variable("OMPI_COMM_WORLD_SIZE").empty() || !environment_variable("PMI_SIZE").empty() ||
           !environment_variable("PMIX_RANK").empty();
}

void refuse_singletons(const Ranks& ranks)
{
    // The first variable that is set counts. mpirun sets its own in a job of Slurm with more tasks.
    constexpr VariableName names[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_NTASKS"};
    const auto* const set = std::ranges::find_if(names, [](auto name) { return !environment_variable(name).empty(); });
    if (ranks.size() > 1 || set == std::end(names)) return;
    const std::string tasks = environment_variable(*set);
    if (parse_whole(tasks).value_or(1) <= 1) return;
    throw InputError(fmt::format(
        "{}: {} tasks were started, but each finds itself alone, expected mpirun or an srun that suits this "
        "program's MPI, one task, or --segments for each",
        set->text, printable(tasks)));
}

#ifndef MANDELMARCH_HAS_MPI
std::unique_ptr<Ranks> make_ranks()
{
    if (started_by_mpi()) {
        throw Unavailable(
            "this program was built without MPI and cannot share work, expected no mpirun or a build with MPI");
    }
    return std::make_unique<Ranks>();
}
#endif

}  // namespace mandelmarch
