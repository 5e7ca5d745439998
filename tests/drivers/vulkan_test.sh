# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE API LAYER MODULES VALIDATION: Vulkan devices that lack features, and
# required properties of the shaders. LAYER: the folder of the fault layer; MODULES: the folder of
# the SPIR-V modules; VALIDATION: the folder of Khronos' validation layer. Lavapipe suffices.
. "$(dirname "$script")/drivers.sh"
modules=$5
validation=$6
export XDG_CACHE_HOME=$top/cache

# On a device that lacks a feature, the program reports an error or renders the same bits as on an intact device.
test_features() {
    local fault fractal
    fractal=bulb refused 77 'has no double' no_double
    refused 77 'division and square root are not exact' double_division
    refused 77 'fuses products and sums of float' contraction --precision float
    for fractal in bulb box; do
        for fault in no_double double_division discrete_gpu; do same $fault --precision float; done
    done
    same discrete_gpu
    # A GPU has other cones than a CPU in fast mode, with which it draws nearly the same picture.
    fractal=bulb size=320x200 both discrete_gpu --mode fast --precision float
    other_picture expected.exr picture.exr
    [ "$(sed -n 's/.* \([0-9]*\) by more than .*/\1/p' difference)" -le 320 ] || fail "$(cat difference)"
    # Eight submissions draw a picture: a probe, three pipelines, and four parts of the work.
    same lost:8
    # If the device's float divisions are a unit off in the last place, the kernel corrects them.
    fractal=bulb refused 77 'division and square root are not exact' float_division --precision float
    for fault in none: float_units:,.float.quotients.corrected; do
        same "${fault%%:*}" --precision float --stats a.json
        grep -q "\"instruction_set\": \"SPIR-V${fault#*:}\"" a.json || fail "$fault: $(grep instruction_set a.json)"
    done
    # Negative control: in fast mode the program does not probe the device. Wrong divisions must change its pictures.
    fractal=bulb
    both double_division --mode fast
    other_picture expected.exr picture.exr
    both float_units --mode fast --precision float
    other_picture expected.exr picture.exr
}

# If the driver or the loader is missing, the backend is unavailable.
test_nothing_there() {
    VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null refused 77 '' none
    VK_ICD_FILENAMES=/dev/null VK_DRIVER_FILES=/dev/null expect 0 "$bin/render" --list-devices
    prints '^vulkan *unavailable: '
    mkdir no_loader
    : >no_loader/libvulkan.so
    : >no_loader/libvulkan.so.1
    LD_LIBRARY_PATH=no_loader expect 0 "$bin/render" --list-devices
    prints '^vulkan *unavailable: no Vulkan loader'
    refused 77 '' none --device 99
    ldd "$bin/render" | grep -q libvulkan && fail "render is linked with the Vulkan loader"
}

# The rays take thousands of steps with few iterations each. If they were marched in one pass, lavapipe would end their
# loops early without an error. Therefore they must be marched in several passes. tests/equivalence has a scene in
# which single DE evaluations have long loops.
test_long_loops() {
    local scene size mode
    sed 's/^-4$/-7/; s/^18 100$/8 100/' "$source/paramsBox.dat" >deep.dat
    "$bin/render" --fractal box deep.dat --size 40x30 --backend openmp --simd-width 1 --precision float --output true.exr
    scene=deep.dat expect 0 draw none --precision float
    same_picture true.exr picture.exr
    same unknown_driver --precision float
    # With an unknown driver, rays are marched in one pass. If the driver ends loops early without an error, the program
    # reports this. If it does not, like newer versions of lavapipe, the picture is correct.
    if scene=deep.dat draw unknown_driver --precision float 2>stderr; then
        same_picture true.exr picture.exr
        return
    fi
    for mode in exact fast; do
        scene=deep.dat refused 1 'cut a ray off in a loop' unknown_driver --precision float --mode $mode
    done
    # `bench equivalence` also detects a driver that ends loops early, and writes parameter files that reproduce the
    # error.
    with unknown_driver "$bin/bench" equivalence --backend vulkan --fractal box --scenes 8 --seed 5 --folder cut \
        >stdout 2>stderr
    [ $? = 1 ] || fail "bench equivalence: another exit code than 1"
    says 'vulkan, device 0, in float: .*cut a ray off'
    for scene in cut/*.dat; do
        size=$(sed -n 7p "$scene" | tr ' ' x) refused 1 'cut a ray off in a loop' unknown_driver --precision float
    done
}

# Every floating-point operation of the exact modules has the decoration NoContraction. Negative control: the check
# rejects the fast modules, whose operations lack it.
test_modules() {
    local module
    for module in "$modules"/*_exact.spv "$modules"/*_corrected.spv; do
        expect 0 "$modules/spirv_tool" check "$module"
    done
    for module in "$modules"/*_fast.spv; do
        "$modules/spirv_tool" check "$module" >stdout && fail "negative control: $(cat stdout)"
    done
}

# Khronos' validation layer reports nothing. Negative control: it reports a misuse of Vulkan.
test_validation() {
    local options layers=:VK_LAYER_KHRONOS_validation
    export VK_KHRONOS_VALIDATION_REPORT_FLAGS=error,warn
    for options in "none" "none --precision float" "none --mode fast" "none --precision float --mode fast" discrete_gpu; do
        expect 0 draw $options
        silent
    done
    draw misuse >stdout 2>stderr
    says 'VUID-VkFenceCreateInfo'
}
[[ " ${CASES-validation} " = *' validation '* ]] || unset -f test_validation
