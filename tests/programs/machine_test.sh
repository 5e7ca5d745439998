# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE: programs use only the cores in their affinity mask, follow OpenMP's
# environment variables, and respect their control group's limits of memory and processor time.
bin=$1
source=$2
unset OMP_NUM_THREADS OMP_THREAD_LIMIT OMP_DYNAMIC OMP_PROC_BIND OMP_PLACES GOMP_CPU_AFFINITY
all=$(sed -n 's/^Cpus_allowed_list:[[:space:]]*//p' /proc/$$/status)
first=${all%%[,-]*}
given=$(nproc)
box=("$bin/render" --fractal box "$source/paramsBox.dat" --size 64x64 --output p.png --stats s.json)

# threads EXPECTED COMMAND...: runs the command and expects this value of `threads` in its stats.
threads() {
    local got
    rm -f s.json
    expect 0 "${@:2}"
    got=$(sed -n 's/.*"threads": \([0-9]*\).*/\1/p' s.json)
    [ "$got" = "$1" ] || fail "$got threads instead of $1: ${*:2}"
}

test_threads() {
    local team line backend
    threads "$given" "${box[@]}" --backend openmp
    threads 1 taskset -c "$first" "${box[@]}" --backend openmp
    threads 1 env OMP_NUM_THREADS=1 "${box[@]}" --backend openmp
    threads 3 env OMP_NUM_THREADS=3,2 "${box[@]}" --backend openmp
    threads 1 env OMP_THREAD_LIMIT=1 "${box[@]}" --backend openmp --threads 3
    threads 2 "${box[@]}" --backend openmp --threads 2
    threads "$given" env OMP_PROC_BIND=true "${box[@]}" --backend openmp
    # With OMP_DYNAMIC, OpenMP may use fewer threads under load. The stats must have the number of threads that OpenMP
    # reports for its team.
    team=$(OMP_DYNAMIC=true OMP_DISPLAY_AFFINITY=TRUE OMP_AFFINITY_FORMAT='team of %N' "${box[@]}" --backend openmp 2>&1 |
        sed -n 's/.*team of \([0-9]*\).*/\1/p' | sort -n | tail -1)
    grep -q "\"threads\": ${team:-1}\b" s.json || fail "a team of ${team:-1} and $(grep threads s.json)"
    for backend in kokkos omptarget stdpar opencl vulkan; do
        has_device $backend || continue
        threads 1 env OMP_NUM_THREADS=1 "${box[@]}" --backend $backend
        threads 1 taskset -c "$first" "${box[@]}" --backend $backend
    done
    export MANDELMARCH_BACKENDS=openmp
    line=$(taskset -c "$first" "$bin/demo" --side 16 2>/dev/null | head -1)
    [[ $line = *", 1 threads" ]] || fail "demo on one core says $line"
}

# OMP_PROC_BIND binds only the threads of OpenMP backends. All other threads, and the device processes, may run on all
# cores.
test_binding() {
    [ "$given" -gt 1 ] || exit 77
    local backend
    for backend in opencl vulkan; do
        has_device $backend || continue
        free_of_places "$bin/render" --fractal box "$source/paramsBox.dat" --size 900x900 --backend $backend --output p.png
    done
    free_of_places "$bin/flythrough" plan q.json --frames 60 --backend openmp
}
free_of_places() {
    local looks=0 bound program process
    OMP_PROC_BIND=true "$@" >/dev/null 2>stderr &
    program=$!
    while kill -0 $program 2>/dev/null && [ $looks -lt 100 ]; do
        for process in $program $(pgrep -P $program) $(pgrep -P "$(pgrep -P $program | paste -sd,)" 2>/dev/null); do
            cat /proc/"$process"/task/*/status 2>/dev/null | sed -n 's/^Cpus_allowed_list:[[:space:]]*//p'
        done >>masks
        sleep 0.05
        looks=$((looks + 1))
    done
    wait $program
    # OpenMP binds the first thread before main() unbinds it. Therefore the first masks that were read may be of a bound
    # thread.
    bound=$(grep -cvx "$all" masks)
    [ $((4 * bound)) -lt "$(wc -l <masks)" ] || fail "$bound of $(wc -l <masks) threads seen are bound: $*"
    rm masks
}

# An option that the selected backend does not support is an error. With `auto`, a backend that supports the option is
# selected.
test_options_of_backends() {
    local backend
    refused() {
        expect 2 "${box[@]}" --backend "$@"
        says 'not supported by backend .*, expected one of .*openmp'
    }
    refused reference --threads 2
    refused reference --simd-width 4
    for backend in opencl vulkan; do
        if has_device $backend; then refused $backend --threads 1; fi
    done
    threads 1 "${box[@]}" --threads 1
}

# limited CONTROLLER FILE1 VALUE1 FILE2 VALUE2: creates a control group and sets a limit in it: VALUE1 in FILE1, a file
# of version 1 of control groups, or VALUE2 in FILE2, a file of version 2. The case is skipped if this user cannot set
# the limit. enter COMMAND...: runs the command in the group.
limited() {
    local parent=/sys/fs/cgroup
    [ -d $parent/"$1" ] && parent=$parent/$1
    group=$parent/mandelmarch-test-$$
    mkdir "$group" 2>/dev/null || exit 77
    trap 'rmdir "$group"; rm -rf "$top"' EXIT
    { echo "$3" >"$group/$2" || echo "$5" >"$group/$4"; } 2>/dev/null || exit 77
}
enter() { sh -c 'echo $$ >"$0/cgroup.procs" && exec "$@"' "$group" "$@"; }

test_quota() {
    limited cpu cpu.cfs_quota_us 50000 cpu.max "50000 100000"
    threads 1 enter "${box[@]}" --backend openmp
}

test_memory() {
    limited memory memory.limit_in_bytes $((700 << 20)) memory.max $((700 << 20))
    # Fills the group's memory with page cache. The file is read twice, because its pages are then on the kernel's list
    # of active pages.
    enter sh -c 'head -c 800M /dev/zero >big; sync big; cat big big >/dev/null'
    expect 0 enter "${box[@]}" --backend openmp
    expect 2 enter "$bin/render" --fractal box "$source/paramsBox.dat" --output p.png --size 16000x16000
    says 'need [0-9]+ MiB of memory and (5[0-9]|6[0-9])[0-9] MiB are available'
}
