#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# drivers_test.sh BIN SOURCE SHIM LAYER: tests OpenCL and Vulkan drivers that abort, crash, exit, hang or return garbage
# while they are loaded, list devices, build, launch, map or are released. Either the picture must exist, or the exit
# code must report a failure. Other backends must not be affected.
set -uo pipefail
bin=$1
source=$2
shim=$3
layer=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
mkdir loaded
echo "$shim" >loaded/driver.icd

# with API STAGE ACTION COMMAND...: runs the command with a driver that misbehaves in this way.
with() {
    local api=$1 stage=$2 action=$3
    shift 3
    export MANDELMARCH_MISCONDUCT="$stage $action"
    if [ "$api" = vulkan ]; then
        VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults VK_LAYER_PATH=$layer timeout 100 "$@"
    elif [ "$stage" = load ]; then
        OCL_ICD_VENDORS=$folder/loaded timeout 100 "$@"
    else
        timeout 100 env LD_PRELOAD="$shim" "$@"
    fi
}

fail() { echo "FAILED: $*" | tee -a failures; }

# picture API STAGE ACTION: renders to a separate file, so that several can run at the same time.
picture() {
    local at=$1-$2-$3
    with "$1" "$2" "$3" "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend "$1" \
        --output "$at.bmp" >"$at.out" 2>"$at.err"
}

# refused API STAGE ACTION TEXT: expects code 1, one line that contains the text, no picture.
refused() {
    local at=$1-$2-$3 code=0
    picture "$1" "$2" "$3" || code=$?
    [ $code = 1 ] || fail "$at: exit code $code: $(head -c 500 "$at.err")"
    [ "$(wc -l <"$at.err")" = 1 ] || fail "$at: $(wc -l <"$at.err") lines: $(head -c 500 "$at.err")"
    grep -q "backend $1: .*$4" "$at.err" || fail "$at: stderr does not say '$4': $(head -c 500 "$at.err")"
    [ ! -e "$at.bmp" ] && [ ! -s "$at.out" ] || fail "$at: it left a picture, or a word on stdout"
}

# drawn API STAGE ACTION: expects the good driver's picture and code 0.
drawn() {
    local at=$1-$2-$3
    picture "$1" "$2" "$3" || fail "$at: exit code $?: $(head -c 500 "$at.err")"
    "$bin/imgdiff" "$1.bmp" "$at.bmp" >/dev/null || fail "$at: another picture"
}

# listed API STAGE ACTION: expects that --list-devices lists the other backends, reports that this one has failed, and
# exits with 1.
listed() {
    local at=list-$1-$2-$3 code=0
    with "$1" "$2" "$3" "$bin/render" --list-devices >"$at" 2>"$at.err" || code=$?
    [ $code = 1 ] || fail "$at: exit code $code"
    for backend in reference openmp; do grep -q "^$backend *0: " "$at" || fail "$at: $backend is missing"; done
    grep -q "^$1 *FAILED: backend $1: .*while listing devices" "$at" || fail "$at: $(grep "^$1" "$at")"
    [ "$(wc -l <"$at")" -ge 5 ] || fail "$at: $(wc -l <"$at") rows"
}

apis=
for api in opencl vulkan; do
    "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend $api --output $api.bmp 2>$api.err
    case $? in
        0) apis="$apis $api" ;;
        77) echo "$api: $(cat $api.err)" ;;
        *) fail "$api without misconduct: $(cat $api.err)" ;;
    esac
done
[ -n "$apis" ] || exit 77

declare -A how=([abort]='signal 6' [crash]='signal 11' [exit]='exit code 0' [leave]='exit code 0')
for api in $apis; do
    for action in abort crash exit leave; do
        for stage in load enumeration build launch map; do refused $api $stage $action "ended the device's process while .*${how[$action]}"; done
        drawn $api release $action
        for stage in load enumeration; do listed $api $stage $action; done
    done
done
# Tests with hangs take long, so they run at the same time.
export MANDELMARCH_DEVICE_TIMEOUT=4
for api in $apis; do
    for stage in load enumeration build launch map; do refused $api $stage hang 'no answer within 4 s' & done
    drawn $api release hang &
    listed_hang() { with $api enumeration hang "$bin/render" --list-devices >list-$api 2>&1; }
    { listed_hang; [ $? = 1 ] && grep -q "^$api *FAILED: .*no answer within 4 s" list-$api && grep -q '^openmp *0: ' list-$api ||
        fail "$api: a list with a driver that hangs: $(cat list-$api)"; } &
done
wait
unset MANDELMARCH_DEVICE_TIMEOUT

# A driver's output appears once on stderr, and unchanged in the log; a log that cannot be written is an error.
for api in $apis; do
    MANDELMARCH_DRIVER_LOG=log-$api picture $api build speak || fail "$api: a driver that speaks: $(cat $api-build-speak.err)"
    [ "$(grep -c 'the driver speaks' $api-build-speak.err)" = 1 ] || fail "$api: its words: $(cat $api-build-speak.err)"
    [ "$(grep -c 'the driver speaks' log-$api)" -ge 2 ] || fail "$api: its log: $(cat log-$api)"
    MANDELMARCH_DRIVER_LOG=no-folder/log picture $api build speak
    [ $? = 2 ] && grep -q '^MANDELMARCH_DRIVER_LOG: no-folder/log: No such file' $api-build-speak.err || fail "$api: $(cat $api-build-speak.err)"
done

# If isolation is off, the driver runs in the program itself, and its crash ends the program.
for api in $apis; do
    for setting in "env MANDELMARCH_ISOLATION=off" "env NO_SETTING=1"; do
        wanted=134
        [[ $setting = *NO_SETTING* ]] && wanted=1
        with $api build abort $setting "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend $api --output none.bmp 2>err
        [ $? = $wanted ] || fail "$api: $setting: another exit code than $wanted: $(cat err)"
    done
    with $api build abort "$bin/render" --no-isolation --fractal box --size 40x30 "$source/paramsBox.dat" --backend $api --output none.bmp 2>err
    [ $? = 134 ] || fail "$api: --no-isolation: $(cat err)"
    "$bin/render" --no-isolation --fractal box --size 40x30 "$source/paramsBox.dat" --backend $api --output inside.bmp 2>err &&
        "$bin/imgdiff" $api.bmp inside.bmp >/dev/null || fail "$api: --no-isolation draws another picture: $(cat err)"
done
MANDELMARCH_ISOLATION=maybe "$bin/render" --list-devices 2>err
[ $? = 2 ] && grep -q "^MANDELMARCH_ISOLATION: 'maybe' given, expected on or off" err || fail "MANDELMARCH_ISOLATION=maybe: $(cat err)"

# A driver that MANDELMARCH_BACKENDS leaves out is not opened, so its faults have no effect.
for api in $apis; do
    MANDELMARCH_BACKENDS=openmp with $api enumeration abort "$bin/render" --list-devices >list 2>err || fail "$api left out: $(cat list err)"
    grep -q "^$api *unavailable: left out by MANDELMARCH_BACKENDS" list || fail "$api left out: $(cat list)"
    grep -q '^openmp *0: ' list || fail "openmp is left out, too: $(cat list)"
done
MANDELMARCH_BACKENDS=openmp,nonsense "$bin/render" --list-devices 2>err
[ $? = 2 ] && grep -q "^MANDELMARCH_BACKENDS: 'nonsense' given, expected some of reference, openmp" err || fail "MANDELMARCH_BACKENDS: $(cat err)"

# Drivers that return garbage: a device name is printed in one line without control characters; a kernel that cannot be
# built is an error; a wrong picture fails verification, and bench reports that and times the other backends.
for api in $apis; do
    with $api enumeration garbage "$bin/render" --list-devices >list 2>err || fail "$api: garbage in a name: $(cat err)"
    grep -q "^$api *0: junk\\\\x1b\[2J\\\\n" list || fail "$api: a name is printed raw: $(grep -a "^$api" list | cat -v)"
    refused $api build garbage ''
done
if [[ $apis = *opencl* ]]; then
    code=0
    with opencl map garbage "$bin/bench" --fractal box --precision float --mode exact --size 32x32 --repetitions 1 --no-peaks \
        --json bench.json >table 2>err || code=$?
    [ $code = 1 ] || fail "bench, garbage: exit code $code"
    grep -q "float *exact *opencl .*FAILED" table || fail "bench, garbage: $(grep opencl table)"
    grep -q 'float *exact *openmp .*same bits' table || fail "bench, garbage: $(grep openmp table)"
    [ -s bench.json ] || fail "bench, garbage: no result"
fi

# If the driver of one backend exits, bench still measures the other backends and writes the result file.
for api in $apis; do
    for stage in enumeration build; do
        code=0
        with $api $stage exit "$bin/bench" --fractal box --precision float --mode exact --size 32x32 --repetitions 1 --no-peaks \
            --json bench-$api-$stage.json >table 2>err || code=$?
        [ $code = 1 ] || fail "$api: bench, exit at $stage: exit code $code"
        for backend in openmp openacc opencl vulkan; do
            [ $backend = $api ] && wanted=FAILED || wanted='same bits\|unavailable'
            grep -q "$backend .*\($wanted\)" table || fail "$api: bench, exit at $stage: $(grep $backend table || echo "no $backend")"
        done
        [ -s bench-$api-$stage.json ] || fail "$api: bench, exit at $stage: no result"
    done
    with $api enumeration exit "$bin/bench" --backend openmp --fractal box --precision float --mode exact --size 32x32 \
        --repetitions 1 --json alone-$api.json >table 2>err || fail "$api: openmp alone: exit code $?: $(cat err)"
    [ -s alone-$api.json ] || fail "$api: openmp alone: no result"
done

# `bench equivalence` continues with the other backends, too.
for api in $apis; do
    code=0
    with $api enumeration exit "$bin/bench" equivalence --fractal box --scenes 2 >table 2>err || code=$?
    [ $code = 1 ] || fail "$api: equivalence, exit at enumeration: exit code $code: $(cat err)"
    grep -q "^FAILED: backend $api: " table || fail "$api: equivalence: $(cat table)"
    grep -q '^openmp .* 0$' table || fail "$api: equivalence: openmp is missing: $(cat table)"
done

# Environment variables of the libraries do not override options: --device selects the device, not ACC_DEVICE_NUM.
if "$bin/render" --list-devices | grep -q '^openacc *0: host'; then
    for number in 0 1; do
        ACC_DEVICE_NUM=$number "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend openacc \
            --output number-$number.bmp 2>err || fail "ACC_DEVICE_NUM=$number: $(cat err)"
    done
    "$bin/imgdiff" number-0.bmp number-1.bmp >/dev/null || fail "ACC_DEVICE_NUM=1 changes the picture"
fi
for name in OMP_STACKSIZE GOMP_STACKSIZE; do
    env $name=16k "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" --backend openmp --output s.bmp 2>err
    [ $? = 2 ] && grep -q "^$name: '16k' given, expected at least 64K" err || fail "$name=16k: $(cat err)"
done
if [[ $apis = *opencl* ]]; then
    POCL_CACHE_DIR='' "$bin/render" --list-devices >list 2>err || fail "an empty POCL_CACHE_DIR: $(cat list err)"
    grep -q '^opencl *0: ' list || fail "an empty POCL_CACHE_DIR: $(cat list)"
    for home in /proc/nope /dev/null; do
        env -u POCL_CACHE_DIR HOME=$home XDG_CACHE_HOME=$home "$bin/render" --fractal box --size 40x30 "$source/paramsBox.dat" \
            --backend opencl --output home.bmp 2>err || fail "caches in $home: $(cat err)"
    done
fi
[ -e failures ] && exit 1
echo "drivers that misbehave: all fine"
