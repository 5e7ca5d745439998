#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# machine_test.sh BIN SOURCE: programs use only the cores in their affinity mask, follow OpenMP's variables, and respect
# the limits of memory and processor time of their control group. Control groups are tested if this user can create
# them.
set -uo pipefail
bin=$(realpath "$1")
source=$2
folder=$(mktemp -d)
groups=()
tidy() {
    local group
    for group in "${groups[@]}"; do rmdir "$group" 2>/dev/null; done
    rm -rf "$folder"
}
trap tidy EXIT
cd "$folder" || exit 1
unset OMP_NUM_THREADS OMP_THREAD_LIMIT OMP_DYNAMIC OMP_PROC_BIND OMP_PLACES GOMP_CPU_AFFINITY
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
all=$(sed -n 's/^Cpus_allowed_list:[[:space:]]*//p' /proc/$$/status)
first=${all%%[,-]*}
given=$(nproc)
box=("$bin/render" --fractal box "$source/paramsBox.dat" --size 64x64 --output p.png --stats s.json)

# threads EXPECTED COMMAND...: runs the command and expects this value of `threads` in its stats.
threads() {
    local expected=$1 got
    shift
    rm -f s.json
    "$@" >/dev/null 2>stderr || fail "$*: $(cat stderr)"
    got=$(sed -n 's/.*"threads": \([0-9]*\).*/\1/p' s.json)
    [ "$got" = "$expected" ] || fail "$got threads instead of $expected: $*"
}
threads "$given" "${box[@]}" --backend openmp
threads 1 taskset -c "$first" "${box[@]}" --backend openmp
threads 1 env OMP_NUM_THREADS=1 "${box[@]}" --backend openmp
threads 3 env OMP_NUM_THREADS=3,2 "${box[@]}" --backend openmp
threads 1 env OMP_THREAD_LIMIT=1 "${box[@]}" --backend openmp
threads 1 env OMP_THREAD_LIMIT=1 "${box[@]}" --backend openmp --threads 3
threads 2 "${box[@]}" --backend openmp --threads 2
threads "$given" env OMP_PROC_BIND=true "${box[@]}" --backend openmp
# With OMP_DYNAMIC, OpenMP may use fewer threads under load. The stats must contain the size of the team that OpenMP
# reports.
team=$(OMP_DYNAMIC=true OMP_DISPLAY_AFFINITY=TRUE OMP_AFFINITY_FORMAT='team of %N' "${box[@]}" --backend openmp 2>&1 |
    sed -n 's/.*team of \([0-9]*\).*/\1/p' | sort -n | tail -1)
grep -q "\"threads\": ${team:-1}\b" s.json || fail "a team of ${team:-1} and $(grep threads s.json)"
for backend in kokkos omptarget stdpar opencl vulkan; do
    "$bin/render" --list-devices 2>/dev/null | grep -q "^$backend *0: " || continue
    threads 1 env OMP_NUM_THREADS=1 "${box[@]}" --backend $backend
    threads 1 taskset -c "$first" "${box[@]}" --backend $backend
done
line=$("$bin/demo" --side 16 2>/dev/null | head -1)
[[ $line = *", $given threads" ]] || fail "demo says $line"
line=$(taskset -c "$first" "$bin/demo" --side 16 2>/dev/null | head -1)
[[ $line = *", 1 threads" ]] || fail "demo on one core says $line"

# OMP_PROC_BIND binds OpenMP's threads only: all other threads, and the device processes, may run on all cores.
free_of_places() {
    local seconds=0 bound
    OMP_PROC_BIND=true "$@" >/dev/null 2>stderr &
    local program=$!
    while kill -0 $program 2>/dev/null && [ $seconds -lt 100 ]; do
        for process in $program $(pgrep -P $program) $(pgrep -P "$(pgrep -P $program | paste -sd,)" 2>/dev/null); do
            cat /proc/"$process"/task/*/status 2>/dev/null | sed -n 's/^Cpus_allowed_list:[[:space:]]*//p'
        done >>masks
        sleep 0.05
        seconds=$((seconds + 1))
    done
    wait $program
    # The first thread is bound until main() begins.
    bound=$(grep -cvx "$all" masks)
    [ $((4 * bound)) -lt "$(wc -l <masks)" ] || fail "$bound of $(wc -l <masks) threads seen are bound: $*"
    rm masks
}
if [ "$given" -gt 1 ]; then
    for backend in opencl vulkan; do
        "$bin/render" --list-devices 2>/dev/null | grep -q "^$backend *0: " || continue
        free_of_places "$bin/render" --fractal box "$source/paramsBox.dat" --size 900x900 --backend $backend --output p.png
    done
    free_of_places "$bin/flythrough" plan q.json --frames 60 --backend openmp
fi

# If a backend does not support a given option, this is an error. With `auto`, a backend that supports it is selected.
refused() {
    "$@" >/dev/null 2>stderr
    [ $? = 2 ] && grep -q 'not supported by backend .*, expected one of .*openmp' stderr || fail "not refused: $*: $(cat stderr)"
}
refused "${box[@]}" --backend reference --threads 2
refused "${box[@]}" --backend reference --simd-width 4
for backend in opencl vulkan; do
    "$bin/render" --list-devices 2>/dev/null | grep -q "^$backend *0: " || continue
    refused "${box[@]}" --backend $backend --threads 1
done
threads 1 "${box[@]}" --threads 1

# group CONTROLLER: creates a control group of version 1 or 2, if this is permitted.
group() {
    local controller=$1 parent=/sys/fs/cgroup
    [ -d $parent/"$controller" ] && parent=$parent/$controller
    made=$parent/mandelmarch-test-$$
    mkdir "$made" 2>/dev/null || return 1
    groups+=("$made")
}
inside() {
    local group=$1
    shift
    sh -c 'echo $$ >"$0/cgroup.procs" && exec "$@"' "$group" "$@"
}
if group cpu && { echo 50000 >"$made/cpu.cfs_quota_us" || echo "50000 100000" >"$made/cpu.max"; } 2>/dev/null; then
    threads 1 inside "$made" "${box[@]}" --backend openmp
else
    echo "no group with a quota can be made here"
fi
if group memory && { echo $((700 << 20)) >"$made/memory.limit_in_bytes" || echo $((700 << 20)) >"$made/memory.max"; } 2>/dev/null; then
    # Fills the group's memory with page cache. Files that were read twice are on the kernel's list of active pages.
    inside "$made" sh -c 'head -c 800M /dev/zero >big; sync big; cat big big >/dev/null'
    inside "$made" "${box[@]}" --backend openmp 2>stderr || fail "a full page cache: $(cat stderr)"
    inside "$made" "$bin/render" --fractal box "$source/paramsBox.dat" --output p.png --size 16000x16000 2>stderr && fail "more memory than the group has"
    grep -Eq 'need [0-9]+ MiB of memory and (5[0-9]|6[0-9])[0-9] MiB are available' stderr || fail "$(cat stderr)"
    rm big
else
    echo "no group with a limit of memory can be made here"
fi
[ $failures = 0 ] && echo "what the machine gives: as expected"
exit $((failures > 0))
