# SPDX-License-Identifier: Apache-2.0
# Cases of flythrough on several MPI ranks, run by tests/cases.sh with BIN SOURCE MPIRUN.
. "$(dirname "$script")/films.sh"
mpirun=$3
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ranks() { timeout 120 "$mpirun" --oversubscribe --bind-to none "$@" 2>stderr; }

test_same_film() {
    whole
    local number
    for number in 1 2 4; do
        ranks -n $number "$program" render path.json $small --output mpi.mp4 || fail "$number ranks: $(cat stderr)"
        says '2 of 2 segments'
        same_file mpi.mp4 whole.mp4 "of $number ranks"
        rm -f mpi.mp4*
    done
}

test_unlike_machines() {
    local other
    other=$(other_instructions)
    # Open MPI 5.0.7 crashes if ranks have different commands.
    ranks -n 2 bash -c '[ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 0 ] || export MANDELMARCH_INSTRUCTIONS=$0; "$@"' \
        "$other" "$program" render path.json $small --output mpi.mp4 &&
        fail "ranks of unlike instruction sets made a film"
    says "rank 1 would render other pictures than rank 0: instructions: 'all of the machine', here '$other'"
}
