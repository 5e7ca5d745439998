# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE LAYER MODULES. They test Vulkan devices that run out of memory, die, hang
# or lack features, broken pipeline caches, and required properties of the shaders. LAYER: the folder of the fault
# layer; MODULES: the folder of the SPIR-V modules. The cases need a Vulkan device; lavapipe suffices.
bin=$1
source=$2
layer=$3
modules=$4
export XDG_CACHE_HOME=$top/cache MANDELMARCH_DEVICE_TIMEOUT=60
[ $case = modules ] || has_device vulkan || exit 77

# draw FRACTAL OUTPUT OPTION...: renders a small picture of the official scene with Vulkan. If they are set, $scene is
# the parameter file and $size the size. The program is killed after 60 seconds.
draw() {
    timeout 60 "$bin/render" --fractal "$1" "${scene:-$source/params${1^}.dat}" --size "${size:-40x30}" --backend vulkan \
        --output "$2" "${@:3}"
}

# right FRACTAL OUTPUT OPTION...: renders the expected picture of the same scene, with openmp's scalar kernel.
right() {
    "$bin/render" --fractal "$1" "${scene:-$source/params${1^}.dat}" --size "${size:-40x30}" --backend openmp \
        --simd-width 1 --output "$2" "${@:3}" 2>stderr || fail "openmp: $(cat stderr)"
}

# with FAULT[:AFTER] COMMAND...: runs the command with the fault layer. AFTER calls succeed before the fault (default
# 0).
with() {
    local after=0
    [[ $1 = *:* ]] && after=${1#*:}
    MANDELMARCH_FAULT=${1%:*} MANDELMARCH_FAULT_AFTER=$after VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults \
        VK_LAYER_PATH=$layer "${@:2}"
}

# refused CODE TEXT FAULT DRAW-ARGUMENTS...: renders with the fault and expects the exit code, one line on stderr that
# contains the text, and no picture.
refused() {
    rm -f "$5"
    expect "$1" with "$3" draw "${@:4}"
    says "$2"
    [ ! -e "$5" ] || fail "$3: a picture"
}

# In each of the next three cases a Vulkan call fails: either the first such call, by which the program probes the
# device, or a later call, for the picture.
test_memory() {
    local after
    for after in 0 2 4 5 6; do refused 1 'out of device memory while taking' memory:$after bulb a.exr; done
}

test_lost() {
    local after
    for after in 0 1 2 3 4; do refused 1 'device lost while' lost:$after box a.exr --precision float; done
    refused 1 'device lost while' lost box a.exr --mode fast
}

test_silent() {
    local after start
    export MANDELMARCH_DEVICE_TIMEOUT=0.3
    for after in 0 3; do
        start=$SECONDS
        refused 1 'no answer within 0.3 s' silent:$after bulb a.exr
        [ $((SECONDS - start)) -lt 20 ] || fail "it took $((SECONDS - start)) seconds to give a silent device up"
    done
}

# On a device that lacks a feature, the program reports an error or renders the same bits as on an intact device.
test_features() {
    refused 77 'has no double' no_double bulb a.exr
    refused 77 'no double' no_double bulb a.exr --mode fast
    refused 77 'division and square root are not exact' double_division bulb a.exr
    refused 77 'fuses products and sums of float' contraction bulb a.exr --precision float
    local fault fractal
    for fractal in bulb box; do
        right $fractal true.exr --precision float
        for fault in none no_double float_units float_division double_division discrete_gpu; do
            expect 0 with $fault draw $fractal a.exr --precision float
            same_picture a.exr true.exr
        done
    done
    # If the device's float divisions are a unit off in the last place, the kernel corrects them. If they are far off,
    # the kernel divides in double.
    for fault in none: float_units:,.float.quotients.corrected float_division:,.float.quotients.in.double; do
        expect 0 with "${fault%%:*}" draw box a.exr --precision float --stats a.json
        grep -q "\"instruction_set\": \"SPIR-V${fault#*:}\"" a.json || fail "$fault: $(grep instruction_set a.json)"
    done
    right box true.exr
    for fault in float_division discrete_gpu; do
        expect 0 with $fault draw box a.exr
        same_picture a.exr true.exr
    done
    with discrete_gpu "$bin/render" --list-devices | grep -q '^vulkan *0: ' || fail "a GPU is not listed"
    # Negative control: in fast mode the program does not probe the device. Wrong divisions must change its pictures.
    expect 0 draw bulb right.exr --mode fast
    expect 0 with double_division draw bulb wrong.exr --mode fast
    other_picture right.exr wrong.exr
    expect 0 draw bulb right.exr --mode fast --precision float
    expect 0 with float_units draw bulb wrong.exr --mode fast --precision float
    other_picture right.exr wrong.exr
}

# If the driver or the loader is missing, the backend is unavailable.
test_nothing_there() {
    VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null expect 77 draw bulb none.exr
    VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null "$bin/render" --list-devices |
        grep -q '^vulkan *unavailable: ' || fail "no driver: --list-devices"
    mkdir no_loader
    : >no_loader/libvulkan.so
    : >no_loader/libvulkan.so.1
    LD_LIBRARY_PATH=no_loader "$bin/render" --list-devices |
        grep -q '^vulkan *unavailable: no Vulkan loader' || fail "no loader: --list-devices"
    expect 77 draw bulb none.exr --device 99
    ldd "$bin/render" | grep -q libvulkan && fail "render is linked with the Vulkan loader"
}

# If the pipeline cache is broken, the picture is the same, no message is printed, and the cache file is written again.
test_pipeline_cache() {
    export XDG_CACHE_HOME=$PWD/cache
    expect 0 draw bulb first.exr
    [ -n "$(find cache -name '*.bin' -size +0)" ] || fail "no pipeline cache was written"
    cp -r cache whole
    local damage
    for damage in 'truncate -s 30' flip empty junk rm; do broken_cache $damage; done
    for file in cache/mandelmarch/*.bin; do rm "$file" && mkfifo "$file"; done
    same_without_a_word
    rm -rf cache
    for damage in /dev/null /proc/nowhere/at/all relative ""; do
        MESA_SHADER_CACHE_DISABLE=true XDG_CACHE_HOME=$damage HOME=/dev/null same_without_a_word
    done
}
same_without_a_word() {
    expect 0 draw bulb again.exr
    silent
    same_picture first.exr again.exr
}
broken_cache() {
    local file
    for file in cache/mandelmarch/*.bin; do "$@" "$file"; done
    rm -rf broken
    cp -r cache broken
    same_without_a_word
    # Some drivers write different bytes each time. Therefore only the size of the new file is compared with the
    # original.
    for file in whole/mandelmarch/*.bin; do
        file=mandelmarch/${file##*/}
        [ "$(stat -c %s "cache/$file")" -ge $(($(stat -c %s "whole/$file") * 9 / 10)) ] && ! cmp -s "cache/$file" "broken/$file" ||
            fail "cache after $*: not rebuilt"
    done
}
flip() { printf '\377' | dd of="$1" bs=1 seek=20 conv=notrunc status=none; }
empty() { : >"$1"; }
junk() { head -c 5000 /dev/urandom >"$1"; }

# The rays take thousands of steps with few iterations each. If they were marched in one pass, lavapipe would end their
# loops early without an error. Therefore they must be marched in several passes. unit/vulkan_test.cpp has a scene in
# which single DE evaluations have long loops.
test_long_loops() {
    local iterations mode
    for iterations in 8 18; do
        sed "s/^-4$/-7/; s/^18 100$/$iterations 100/" "$source/paramsBox.dat" >deep.dat
        scene=deep.dat right box true.exr --precision float
        scene=deep.dat expect 0 draw box a.exr --precision float
        same_picture a.exr true.exr
    done
    # With an unknown driver, rays are marched in one pass. If the driver ends loops early without an error, the program
    # reports this. If it does not, like newer versions of lavapipe, the picture is correct.
    if scene=deep.dat with unknown_driver draw box a.exr --precision float 2>stderr; then
        same_picture a.exr true.exr
        return
    fi
    for mode in exact fast; do
        scene=deep.dat refused 1 'cut a ray off in a loop' unknown_driver box a.exr --precision float --mode $mode
    done
    # `bench equivalence` also detects a driver that ends loops early, and writes parameter files that reproduce the
    # error.
    with unknown_driver "$bin/bench" equivalence --backend vulkan --fractal box --scenes 8 --seed 5 --folder cut \
        >stdout 2>stderr
    [ $? = 1 ] || fail "bench equivalence: another exit code than 1"
    says 'vulkan, device 0, in float: .*cut a ray off'
    for scene in cut/*.dat; do
        size=$(sed -n 7p "$scene" | tr ' ' x) refused 1 'cut a ray off in a loop' unknown_driver box a.exr --precision float
    done
    unset scene
    right box true.exr --precision float
    expect 0 with unknown_driver draw box a.exr --precision float
    same_picture a.exr true.exr
}

# Every floating-point operation of the exact modules has the decoration NoContraction. Negative control: the check
# rejects the fast modules, whose operations lack it.
test_modules() {
    local module
    for module in "$modules"/*_exact.spv "$modules"/*_pinned.spv "$modules"/*_corrected.spv; do
        expect 0 "$modules/spirv_tool" check "$module"
    done
    for module in "$modules"/*_fast.spv; do
        "$modules/spirv_tool" check "$module" >stdout && fail "negative control: $(cat stdout)"
    done
}
