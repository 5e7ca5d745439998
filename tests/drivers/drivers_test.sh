# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE API FAULTS. A driver of OpenCL or Vulkan ends its process, hangs, runs out
# of memory, loses its device or returns garbage. Either the picture must exist, or the exit code must report a failure.
# Other backends must not be affected. unit/isolation_test.cpp tests more ways in which a process can end.
. "$(dirname "$script")/drivers.sh"

# listed FAULT TEXT: expects that --list-devices lists the other backends, and reports for the driver's backend that it
# has failed.
listed() {
    with "$1" "$bin/render" --list-devices >stdout 2>stderr
    [ $? = 1 ] || fail "$1: a list with another exit code than 1"
    for backend in reference openmp; do prints "^$backend *0: "; done
    prints "^$api *FAILED: .*$2"
}

test_end() {
    local stage
    for stage in load list build launch map; do
        refused 1 "backend $api: .*ended the device's process while .*signal 6" "$stage abort"
    done
    same 'release abort'
    for stage in load list; do listed "$stage abort" 'while listing devices'; done
}

# The stages run at the same time, because each hang takes seconds.
test_hang() {
    local patience=4 stage
    for stage in load list build launch map; do
        (mkdir $stage && cd $stage && refused 1 'no answer within 4 s' "$stage hang") &
    done
    patience=10 same 'release hang'
    listed 'list hang' 'no answer within 4 s'
    wait
}

# A call of the driver fails: either the first such call, by which the program probes the device, or a later call, for
# the picture.
test_failure() {
    local after
    for after in 0 4; do refused 1 'out of (device )?memory' memory:$after; done
    refused 1 'device lost while|out of resources, or died' lost
    for after in 0 2; do patience=0.3 refused 1 'no answer within 0.3 s' silent:$after; done
}

# A driver's output appears once on stderr, and unchanged in the log; a log that cannot be written is an error.
test_output() {
    MANDELMARCH_DRIVER_LOG=log draw 'build speak' 2>stderr || fail "a driver that prints: $(cat stderr)"
    [ "$(grep -c 'the driver speaks' stderr)" = 1 ] || fail "its output: $(cat stderr)"
    [ "$(grep -c 'the driver speaks' log)" -ge 2 ] || fail "its log: $(cat log)"
    MANDELMARCH_DRIVER_LOG=no-folder/log refused 2 '^MANDELMARCH_DRIVER_LOG: no-folder/log: No such file' 'build speak'
}

# If isolation is off, the driver runs in the program itself, and its crash ends the program.
test_no_isolation() {
    MANDELMARCH_ISOLATION=off expect 134 draw 'build abort'
    expect 134 draw 'build abort' --no-isolation
    expect 0 draw none --no-isolation
    mv picture.exr inside.exr
    expect 0 draw none
    same_picture inside.exr picture.exr
}

# A driver that MANDELMARCH_BACKENDS leaves out is not opened, so its faults have no effect.
test_left_out() {
    MANDELMARCH_BACKENDS=openmp expect 0 with 'list abort' "$bin/render" --list-devices
    prints "^$api *unavailable: left out by MANDELMARCH_BACKENDS"
    prints '^openmp *0: '
}

# A driver returns garbage. A device's name is printed in one line without control characters. A kernel that cannot be
# built is an error.
test_garbage() {
    expect 0 with 'list garbage' "$bin/render" --list-devices
    prints "^$api *0: junk\\\\x1b\[2J\\\\n"
    refused 1 "backend $api: " 'build garbage'
}

# If the driver of one backend exits, bench still measures the other backends and writes the result file.
test_bench() {
    local measure=("$bin/bench" --fractal box --precision float --mode exact --size 32x32 --repetitions 1 --no-peaks)
    with 'build exit' "${measure[@]}" --json result.json >stdout 2>stderr
    [ $? = 1 ] || fail "another exit code than 1: $(cat stderr)"
    prints "float *exact *$api .*FAILED"
    prints 'float *exact *openmp .*same bits'
    [ -s result.json ] || fail "no result"
    expect 0 with 'list exit' "${measure[@]}" --backend openmp
    with 'list exit' "$bin/bench" equivalence --fractal box --scenes 2 >stdout 2>stderr
    [ $? = 1 ] || fail "equivalence: another exit code than 1: $(cat stderr)"
    prints "^FAILED: backend $api: "
    prints '^openmp .* 0$'
}
