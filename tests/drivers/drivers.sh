# SPDX-License-Identifier: Apache-2.0
# Sourced by opencl_test.sh and vulkan_test.sh, with the words BIN SOURCE API FAULTS: functions that run programs on a
# device whose driver has a fault (faults.h), and cases of both APIs. A driver ends its process, runs out of memory, loses
# its device or returns garbage. Either the picture must exist, or the exit code must report a failure. Other backends
# must not be affected. FAULTS: the shim of OpenCL or the folder of Vulkan's layer. unit/isolation_test.cpp tests more
# ways in which a process can end, and processes that hang.
bin=$1
source=$2
api=$3
faults=$4
[ $case = modules ] || has_device "$api" || exit 77

# with FAULT[:AFTER] COMMAND...: runs the command with the fault, after AFTER calls that succeed (default 0).
with() {
    local -x MANDELMARCH_FAULT=${1%:*} MANDELMARCH_FAULT_AFTER=0 MANDELMARCH_DEVICE_TIMEOUT=${patience:-60}
    [[ $1 = *:* ]] && MANDELMARCH_FAULT_AFTER=${1#*:}
    if [ "$api" = vulkan ]; then
        VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults${layers:-} VK_LAYER_PATH=$faults${validation:+:$validation} \
            timeout 100 "${@:2}"
    elif [[ $1 = load* ]]; then
        mkdir -p loaded
        echo "$faults" >loaded/driver.icd
        OCL_ICD_VENDORS=$PWD/loaded timeout 100 "${@:2}"
    else
        timeout 100 env LD_PRELOAD="$faults" "${@:2}"
    fi
}

# draw FAULT OPTION...: renders a small picture. If they are set, $fractal is the fractal, $scene the parameter file and
# $size the size.
draw() {
    local fractal=${fractal:-box}
    with "$1" "$bin/render" --fractal $fractal "${scene:-$source/params${fractal^}.dat}" --size "${size:-40x30}" \
        --backend "$api" --output picture.exr "${@:2}"
}

# refused CODE TEXT FAULT OPTION...: renders and expects the exit code, one line on stderr that matches the text, and no
# picture.
refused() {
    rm -f picture.exr
    expect "$1" draw "${@:3}"
    says "$2"
    [ ! -e picture.exr ] && [ ! -s stdout ] || fail "$3: it left a picture, or a word on stdout"
}

# both FAULT OPTION...: renders without and with the fault. same FAULT OPTION...: expects the same picture.
both() {
    patience='' expect 0 draw none "${@:2}"
    mv picture.exr expected.exr
    expect 0 draw "$@"
}
same() {
    both "$@"
    same_picture expected.exr picture.exr
}

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
    # A driver that MANDELMARCH_BACKENDS leaves out is not opened, so its faults have no effect.
    MANDELMARCH_BACKENDS=openmp expect 0 with 'list abort' "$bin/render" --list-devices
    prints "^$api *unavailable: left out by MANDELMARCH_BACKENDS"
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
