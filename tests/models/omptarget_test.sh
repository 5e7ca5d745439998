# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE CLANG: omptarget in the programs of the folder CLANG, which clang++ built.
# Its devices are the host's cores, by a plugin of LLVM's library libomptarget, which loads kernels as a GPU's plugin
# does. Exact pictures have the bits of the scalar kernel in the programs of BIN, which g++ built. Skipped if LLVM's
# packages have no such plugin.
bin=$1
source=$2
clang=$3
cp "$source"/params*.dat .
export OMP_TARGET_OFFLOAD=MANDATORY  # LLVM's library ends a program that would run a loop on the host instead
[ -x "$clang/render" ] || fail "$clang has no program render"
library=$(ldd "$clang/render" | awk '$1 == "libomptarget.so" { print $3 }')
if [ ! -e "${library%/*}/libomptarget.rtl.x86_64.so" ]; then
    echo "SKIPPED: no libomptarget.rtl.x86_64.so beside '$library'"
    exit 77
fi
# device FRACTAL FILE OPTION...: renders on a device. host FRACTAL FILE OPTION...: renders with g++'s scalar kernel.
device() {
    expect 0 "$clang/render" --fractal "$1" "$2" --size 170x131 --backend omptarget --output device.exr --stats device.json "${@:3}"
}
host() {
    expect 0 "$bin/render" --fractal "$1" "$2" --size 170x131 --backend openmp --simd-width 1 --output host.exr --stats host.json "${@:3}"
}

# In exact mode a device draws the scalar kernel's bits and does the same work. Negative control: fast mode.
test_bits() {
    local scene precision
    sed 's/^0 4.0 8.0/0 4.0 7.5/' paramsBulb.dat >power.dat
    sed 's/^2 0.5 1/-1.5 0.5 1/' paramsBox.dat >scale.dat
    for scene in "bulb paramsBulb.dat" "bulb power.dat" "box scale.dat" "box paramsBox.dat"; do
        for precision in float double; do
            device $scene --precision $precision
            host $scene --precision $precision
            same_picture device.exr host.exr
            [ "$(grep -A3 '"work"' device.json)" = "$(grep -A3 '"work"' host.json)" ] || fail "other work: $scene"
        done
    done
    grep -q '"name": "offload device 0: the host.s cores"' device.json ||
        fail "drawn by $(grep name device.json)"
    device $scene --mode fast
    other_picture device.exr host.exr
}

# The kernels run on the device. Negative control: if the plugin is missing, no picture is drawn.
test_plugin() {
    local before
    before=$(ls /tmp/tmpfile_* 2>/dev/null)
    LIBOMPTARGET_INFO=1 device bulb paramsBulb.dat --device 1
    says 'Libomptarget device 1 info: Entering OpenMP kernel'
    host bulb paramsBulb.dat
    same_picture device.exr host.exr
    [ "$(ls /tmp/tmpfile_* 2>/dev/null)" = "$before" ] || fail "a file is left in /tmp"

    mkdir alone
    cp "$library" alone
    export LD_LIBRARY_PATH=$PWD/alone
    rm device.exr
    "$clang/render" --fractal bulb paramsBulb.dat --size 170x131 --backend omptarget --output device.exr 2>stderr
    [ $? = 1 ] || fail "the exit code without a device is not 1"
    says 'Libomptarget fatal error 1: failure of target construct while offloading is mandatory'
    [ -e device.exr ] && fail "a picture without a device"
    OMP_TARGET_OFFLOAD=DEFAULT device bulb paramsBulb.dat
    says 'runs on the host, its cores: no offload device here'
    same_picture device.exr host.exr
}
