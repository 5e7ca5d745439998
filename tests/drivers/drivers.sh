# SPDX-License-Identifier: Apache-2.0
# Sourced by scripts of cases with the words BIN SOURCE API FAULTS: functions that run programs on a device of OpenCL or
# Vulkan whose driver has a fault (faults.h). FAULTS: the shim of OpenCL or the folder of Vulkan's layer.
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
