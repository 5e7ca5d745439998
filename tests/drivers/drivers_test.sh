# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE API FAULTS. A driver of OpenCL or Vulkan aborts, crashes, exits, hangs or
# returns garbage while it is loaded, lists devices, builds, launches, maps or is released. Either the picture must
# exist, or the exit code must report a failure. Other backends must not be affected. FAULTS: the shim of opencl_faults
# or the folder of vulkan_faults' layer.
bin=$1
source=$2
api=$3
faults=$4
mkdir loaded
echo "$faults" >loaded/driver.icd
vendors=$PWD/loaded
has_device "$api" || exit 77

# with STAGE ACTION COMMAND...: runs the command with a driver that misbehaves in this way.
with() {
    local -x MANDELMARCH_MISCONDUCT="$1 $2"
    if [ "$api" = vulkan ]; then
        VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults VK_LAYER_PATH=$faults timeout 100 "${@:3}"
    elif [ "$1" = load ]; then
        OCL_ICD_VENDORS=$vendors timeout 100 "${@:3}"
    else
        timeout 100 env LD_PRELOAD="$faults" "${@:3}"
    fi
}
draw=("$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend "$api" --output picture.bmp)
measure=("$bin/bench" --fractal box --precision float --mode exact --size 32x32 --repetitions 1)

# refused STAGE ACTION TEXT: renders and expects exit code 1, one line that contains the text, and no picture. Uses its
# own folder, so that several calls can run at the same time.
refused() {
    (
        mkdir "$1-$2"
        cd "$1-$2" || exit
        expect 1 with "$1" "$2" "${draw[@]}"
        says "backend $api: .*$3"
        [ ! -e picture.bmp ] && [ ! -s stdout ] || fail "$1, $2: it left a picture, or a word on stdout"
    )
}

# drawn STAGE ACTION: expects the picture that is rendered without the fault.
drawn() {
    expect 0 "${draw[@]}"
    mv picture.bmp good.bmp
    expect 0 with "$1" "$2" "${draw[@]}"
    same_picture good.bmp picture.bmp
}

# listed STAGE ACTION TEXT: expects that --list-devices lists the other backends, and reports for the driver's backend
# that it has failed.
listed() {
    with "$1" "$2" "$bin/render" --list-devices >stdout 2>stderr
    [ $? = 1 ] || fail "$1, $2: a list with another exit code than 1"
    for backend in reference openmp; do prints "^$backend *0: "; done
    prints "^$api *FAILED: .*$3"
    [ "$(wc -l <stdout)" -ge 5 ] || fail "$1, $2: $(wc -l <stdout) rows"
}

# ends ACTION HOW: expects for each stage that, if the driver ends its process by ACTION, the message contains HOW.
# unit/isolation_test.cpp tests more ways in which a process can end.
ends() {
    local stage
    for stage in load enumeration build launch map; do refused $stage "$1" "ended the device's process while .*$2"; done
    drawn release "$1"
    for stage in load enumeration; do listed $stage "$1" 'while listing devices'; done
}
test_abort() { ends abort 'signal 6'; }
test_crash() { ends crash 'signal 11'; }
test_exit() { ends exit 'exit code 0'; }

# The stages run at the same time, because each hang takes seconds.
test_hang() {
    export MANDELMARCH_DEVICE_TIMEOUT=4
    for stage in load enumeration build launch map; do refused $stage hang 'no answer within 4 s' & done
    MANDELMARCH_DEVICE_TIMEOUT=10 drawn release hang
    listed enumeration hang 'no answer within 4 s'
    wait
}

# A driver's output appears once on stderr, and unchanged in the log; a log that cannot be written is an error.
test_speak() {
    MANDELMARCH_DRIVER_LOG=log with build speak "${draw[@]}" 2>stderr || fail "a driver that speaks: $(cat stderr)"
    [ "$(grep -c 'the driver speaks' stderr)" = 1 ] || fail "its words: $(cat stderr)"
    [ "$(grep -c 'the driver speaks' log)" -ge 2 ] || fail "its log: $(cat log)"
    MANDELMARCH_DRIVER_LOG=no-folder/log expect 2 with build speak "${draw[@]}"
    says '^MANDELMARCH_DRIVER_LOG: no-folder/log: No such file'
}

# If isolation is off, the driver runs in the program itself, and its crash ends the program.
test_no_isolation() {
    MANDELMARCH_ISOLATION=off expect 134 with build abort "${draw[@]}"
    expect 134 with build abort "${draw[@]}" --no-isolation
    expect 1 with build abort "${draw[@]}"
    expect 0 "${draw[@]}" --no-isolation
    mv picture.bmp inside.bmp
    expect 0 "${draw[@]}"
    same_picture inside.bmp picture.bmp
}

# A driver that MANDELMARCH_BACKENDS leaves out is not opened, so its faults have no effect.
test_left_out() {
    MANDELMARCH_BACKENDS=openmp expect 0 with enumeration abort "$bin/render" --list-devices
    prints "^$api *unavailable: left out by MANDELMARCH_BACKENDS"
    prints '^openmp *0: '
}

# A driver returns garbage. A device's name is printed in one line without control characters. A kernel that cannot be
# built is an error.
test_garbage() {
    expect 0 with enumeration garbage "$bin/render" --list-devices
    prints "^$api *0: junk\\\\x1b\[2J\\\\n"
    refused build garbage ''
}

# If the driver of one backend exits, bench still measures the other backends and writes the result file.
test_bench() {
    local stage backend wanted
    for stage in enumeration build; do
        with $stage exit "${measure[@]}" --no-peaks --json $stage.json >stdout 2>stderr
        [ $? = 1 ] || fail "exit at $stage: another exit code than 1: $(cat stderr)"
        for backend in openmp openacc opencl vulkan; do
            [ $backend = "$api" ] && wanted=FAILED || wanted='same bits|unavailable'
            prints "$backend .*($wanted)"
        done
        [ -s $stage.json ] || fail "exit at $stage: no result"
    done
    expect 0 with enumeration exit "${measure[@]}" --backend openmp --json alone.json
    [ -s alone.json ] || fail "openmp alone: no result"
    with enumeration exit "$bin/bench" equivalence --fractal box --scenes 2 >stdout 2>stderr
    [ $? = 1 ] || fail "equivalence: another exit code than 1: $(cat stderr)"
    prints "^FAILED: backend $api: "
    prints '^openmp .* 0$'
}
