# SPDX-License-Identifier: Apache-2.0
# Case run by tests/cases.sh with BIN SOURCE LAYER VALIDATION: Khronos' validation layer, in the folder VALIDATION,
# reports nothing.
bin=$1
source=$2
layer=$3
validation=$4
export XDG_CACHE_HOME=$PWD/cache VK_KHRONOS_VALIDATION_REPORT_FLAGS=error,warn
has_device vulkan || exit 77
# draw LAYERS FRACTAL OPTION...: renders a small picture with these layers, which are separated by colons.
draw() {
    VK_LAYER_PATH=$layer:$validation VK_INSTANCE_LAYERS=$1 timeout 60 "$bin/render" --fractal "$2" \
        "$source/params${2^}.dat" --size 40x30 --backend vulkan --output valid.exr "${@:3}"
}
# clean DRAW-ARGUMENTS...: expects that the program prints nothing.
clean() {
    expect 0 draw "$@"
    [ ! -s stdout ] && [ ! -s stderr ] || fail "validation, $*: $(cat stdout stderr | head -c 500)"
}

test_validation() {
    local options khronos=VK_LAYER_KHRONOS_validation faults=VK_LAYER_MANDELMARCH_faults
    for options in "bulb" "bulb --precision float" "box --mode fast" "box --precision float --mode fast"; do
        clean $khronos $options
    done
    MANDELMARCH_FAULT=discrete_gpu clean $khronos:$faults bulb
    # Negative control: the validation layer reports a misuse of Vulkan.
    MANDELMARCH_FAULT=misuse draw $faults:$khronos bulb >stdout 2>stderr
    says 'VUID-VkFenceCreateInfo'
}
