#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# faults_test.sh BIN SOURCE LAYER MODULES: tests Vulkan devices that run out of memory, die, hang or lack features,
# broken pipeline caches, and required properties of the shaders. Needs a Vulkan device (lavapipe suffices).
set -uo pipefail
bin=$1
source=$2
layer=$3
modules=$4
. "$source/tests/failures.sh"
cd "$folder"
export XDG_CACHE_HOME=$folder/cache MANDELMARCH_DEVICE_TIMEOUT=60
validation=/usr/share/vulkan/explicit_layer.d

# draw FRACTAL OUTPUT OPTION...: renders a small picture with Vulkan, of the official scene or, if they are set, of the
# file $scene at $size. Returns the exit code; the program is killed after 60 seconds.
draw() {
    local fractal=$1 output=$2
    shift 2
    timeout 60 "$bin/render" --fractal "$fractal" "${scene:-$source/params${fractal^}.dat}" --size "${size:-40x30}" \
        --backend vulkan --output "$output" "$@" >stdout 2>stderr </dev/null
}

# with FAULT[:AFTER] COMMAND...: runs the command with the layer that simulates the fault.
with() {
    local fault=$1
    shift
    MANDELMARCH_FAULT=${fault%:*} MANDELMARCH_FAULT_AFTER=$([[ $fault = *:* ]] && echo "${fault#*:}" || echo 0) \
        VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults VK_LAYER_PATH=$layer:$validation "$@"
}

# refused CODE TEXT FAULT DRAW-ARGUMENTS...: expects the exit code, one line on stderr that contains the text, and no
# file.
refused() {
    local code=$1 text=$2 fault=$3 got
    shift 3
    rm -f ./*.exr
    with "$fault" draw "$@"
    got=$?
    [ $got = "$code" ] || fail "$fault: exit code $got, expected $code: $(head -c 300 stderr)"
    [ "$(wc -l <stderr)" = 1 ] || fail "$fault: $(wc -l <stderr) lines on stderr: $(head -c 300 stderr)"
    grep -q "$text" stderr || fail "$fault: stderr does not say '$text': $(head -c 300 stderr)"
    [ -z "$(find . -maxdepth 1 -name '*.exr' -o -name '.mandelmarch-*')" ] || fail "$fault: a file is left"
}

# same A B: expects two equal pictures.
same() { "$bin/imgdiff" "$1" "$2" >stdout || fail "$1 and $2 differ: $(tr '\n' ' ' <stdout)"; }

if "$bin/render" --fractal bulb --list-devices | grep '^vulkan *unavailable'; then exit 77; fi

# Renders a picture on the device without faults, and the expected pictures: the same kernel source without Vulkan.
draw bulb good.exr || { fail "no picture without a fault: $(cat stderr)"; exit 1; }
mkdir -p true
for fractal in bulb box; do
    for precision in float double; do
        "$bin/render" --fractal $fractal "$source/params${fractal^}.dat" --size 40x30 --backend openmp --simd-width 1 \
            --precision $precision --output true/$fractal-$precision.exr || fail "openmp"
    done
done

# Failures at the first call, which is made by a probe of the device, and at later calls, which are made for the
# picture.
for after in 0 2 4 5 6; do
    refused 1 'out of device memory while taking' memory:$after bulb a.exr
done
for after in 0 1 2 3 4; do
    refused 1 'device lost while' lost:$after box a.exr --precision float
done
refused 1 'device lost while' lost box a.exr --mode fast
MANDELMARCH_DEVICE_TIMEOUT=0.3
for after in 0 3; do
    start=$SECONDS
    refused 1 'no answer within 0.3 s' silent:$after bulb a.exr
    [ $((SECONDS - start)) -lt 20 ] || fail "it took $((SECONDS - start)) seconds to give a silent device up"
done
MANDELMARCH_DEVICE_TIMEOUT=60

# Devices that lack a feature give an error, or pictures with the same bits.
refused 77 'has no double' no_double bulb a.exr
refused 77 'no double' no_double bulb a.exr --mode fast
refused 77 'division and square root are not exact' double_division bulb a.exr
for fault in none no_double float_units float_division double_division discrete_gpu; do
    for fractal in bulb box; do
        with $fault draw $fractal a.exr --precision float && same a.exr true/$fractal-float.exr
    done
done
# Float division is done by the device; it is corrected if the device's results are a unit off in the last place, and
# done in double if they are far off.
for fault in none: float_units:,.float.quotients.corrected float_division:,.float.quotients.in.double; do
    with "${fault%%:*}" draw box a.exr --precision float --stats a.json
    grep -q "\"instruction_set\": \"SPIR-V${fault#*:}\"" a.json || fail "$fault: $(grep instruction_set a.json)"
done
refused 77 'fuses products and sums of float' contraction bulb a.exr --precision float
for fault in float_division discrete_gpu; do
    with $fault draw box a.exr && same a.exr true/box-double.exr
done
with discrete_gpu "$bin/render" --fractal bulb --list-devices | grep -q '^vulkan *0: ' || fail "a GPU is not listed"
# Negative control: fast mode does not probe the device, so the wrong divisions must change its pictures.
with double_division draw bulb wrong.exr --mode fast
draw bulb right.exr --mode fast
"$bin/imgdiff" wrong.exr right.exr >stdout && fail "the layer changes no division"
draw bulb right.exr --mode fast --precision float
with float_units draw bulb wrong.exr --mode fast --precision float
"$bin/imgdiff" wrong.exr right.exr >stdout && fail "the layer changes no float division"

# Without a driver or a loader the backend is unavailable.
VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null draw bulb none.exr
[ $? = 77 ] && [ "$(wc -l <stderr)" = 1 ] || fail "no driver: $(cat stderr)"
VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null "$bin/render" --fractal bulb --list-devices |
    grep -q '^vulkan *unavailable: ' || fail "no driver: --list-devices"
mkdir no_loader
: >no_loader/libvulkan.so
: >no_loader/libvulkan.so.1
LD_LIBRARY_PATH=no_loader "$bin/render" --fractal bulb --list-devices |
    grep -q '^vulkan *unavailable: no Vulkan loader' || fail "no loader: --list-devices"
draw bulb none.exr --device 99
[ $? = 77 ] || fail "device 99: $(cat stderr)"
ldd "$bin/render" | grep -q libvulkan && fail "render is linked with the Vulkan loader"

# With a broken pipeline cache, the picture is the same, there is no message, and the file is written again.
rm -rf cache
draw bulb first.exr
cache=$(find cache -name '*.bin' | sort | head -1)
[ -s "$cache" ] || fail "no pipeline cache was written"
cp -r cache whole
break_cache() {
    local file
    for file in cache/mandelmarch/*.bin; do "$@" "$file"; done
    rm -rf broken
    cp -r cache broken
    draw bulb again.exr || fail "cache after $*: $(cat stderr)"
    [ -s stderr ] && fail "cache after $*: $(cat stderr)"
    same first.exr again.exr
    # The file is not compared with the original one byte for byte, as not every driver writes the same bytes again.
    for file in whole/mandelmarch/*.bin; do
        file=mandelmarch/${file##*/}
        [ "$(stat -c %s "cache/$file")" -ge $(($(stat -c %s "whole/$file") * 9 / 10)) ] && ! cmp -s "cache/$file" "broken/$file" ||
            fail "cache after $*: not rebuilt"
    done
}
flip() { printf '\377' | dd of="$1" bs=1 seek=20 conv=notrunc status=none; }
empty() { : >"$1"; }
junk() { head -c 5000 /dev/urandom >"$1"; }
break_cache truncate -s 30
break_cache flip
break_cache empty
break_cache junk
break_cache rm
for file in cache/mandelmarch/*.bin; do rm "$file" && mkfifo "$file"; done
draw bulb again.exr || fail "pipes in place of the cache: $(cat stderr)"
[ -s stderr ] && fail "pipes in place of the cache: $(cat stderr)"
same first.exr again.exr
rm -rf cache
for folder_for_cache in /dev/null /proc/nowhere/at/all relative ""; do
    MESA_SHADER_CACHE_DISABLE=true XDG_CACHE_HOME=$folder_for_cache HOME=/dev/null draw bulb again.exr ||
        fail "cache in '$folder_for_cache'"
    [ -s stderr ] && fail "cache in '$folder_for_cache': $(cat stderr)"
done

# Rays of thousands of steps with few iterations each. In one pass, lavapipe would end their loops early without an
# error, so they must be marched in several passes. unit/vulkan_test.cpp has a scene whose DE evaluations are that long.
for iterations in 8 18; do
    sed "s/^-4$/-7/; s/^18 100$/$iterations 100/" "$source/paramsBox.dat" >deep-$iterations.dat
done
for scene in deep-*.dat; do
    "$bin/render" --fractal box $scene --size 40x30 --backend openmp --simd-width 1 --precision float --output true/deep.exr ||
        fail "openmp"
    draw box a.exr --precision float && same a.exr true/deep.exr || fail "$scene: another picture"
done
# If an unknown driver ends loops early without an error, this is detected. If it does not, like newer versions of
# lavapipe, the picture is correct.
scene=deep-18.dat
"$bin/render" --fractal box $scene --size 40x30 --backend openmp --simd-width 1 --precision float --output true/deep-18.exr ||
    fail "openmp"
if with unknown_driver draw box a.exr --precision float; then
    same a.exr true/deep-18.exr
    unset scene
else
    for mode in exact fast; do
        refused 1 'cut a ray off in a loop' unknown_driver box a.exr --precision float --mode $mode
    done
    unset scene
    # `bench equivalence` detects such a driver, too, and writes parameter files that reproduce the error.
    with unknown_driver "$bin/bench" equivalence --backend vulkan --fractal box --scenes 8 --seed 5 --folder cut \
        >stdout 2>stderr
    [ $? = 1 ] && grep -q 'vulkan, device 0, in float: .*cut a ray off' stderr || fail "bench equivalence: $(cat stderr)"
    for scene in cut/*.dat; do
        size=$(sed -n 7p "$scene" | tr ' ' x)
        refused 1 'cut a ray off in a loop' unknown_driver box a.exr --precision float
    done
    unset scene size
    with unknown_driver draw box a.exr --precision float && same a.exr true/box-float.exr || fail "an unknown driver"
fi

# The validation layers do not report anything. Negative control: they report a misuse.
if [ -e $validation/VkLayer_khronos_validation.json ]; then
    export VK_KHRONOS_VALIDATION_REPORT_FLAGS=error,warn
    validated() { VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation draw "$@"; }
    for options in "bulb" "bulb --precision float" "box --mode fast" "box --precision float --mode fast"; do
        set -- $options
        validated "$1" valid.exr "${@:2}" || fail "validation, $options: $(cat stderr)"
        [ -s stdout ] || [ -s stderr ] && fail "validation, $options: $(cat stdout stderr | head -c 500)"
    done
    MANDELMARCH_FAULT=discrete_gpu VK_LAYER_PATH=$layer:$validation \
        VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation:VK_LAYER_MANDELMARCH_faults draw bulb valid.exr
    [ -s stdout ] || [ -s stderr ] && fail "validation, GPU: $(cat stdout stderr | head -c 500)"
    MANDELMARCH_FAULT=misuse VK_LAYER_PATH=$layer:$validation \
        VK_INSTANCE_LAYERS=VK_LAYER_MANDELMARCH_faults:VK_LAYER_KHRONOS_validation draw bulb valid.exr
    grep -q 'VUID-VkFenceCreateInfo' stderr || fail "validation does not see a misuse"
else
    echo "no validation layers here"
fi

# Every floating-point operation of the exact modules has NoContraction. Negative control: in the fast modules none has.
for module in "$modules"/*_exact.spv "$modules"/*_pinned.spv "$modules"/*_corrected.spv; do
    "$modules/spirv_tool" check "$module" >stdout || fail "$(cat stdout)"
done
for module in "$modules"/*_fast.spv; do
    "$modules/spirv_tool" check "$module" >stdout && fail "the twin: $(cat stdout)"
done

finish
