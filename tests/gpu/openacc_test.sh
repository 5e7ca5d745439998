# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE: without a GPU, openacc has one device, the host. It reports that the host
# renders, and rejects any other device. tests/models tests the pictures.
bin=$1
source=$2
export CUDA_VISIBLE_DEVICES=  # hides any GPU
bulb() { "$bin/mandelbulb" "$source/paramsBulb.dat" --size 60x40 --backend "$@"; }

test_without_a_gpu() {
    expect 0 bulb openacc --output a.png --stats a.json
    says '^backend openacc: runs on the host, one thread: no NVIDIA GPU'
    grep -q '"name": "host, one thread: no NVIDIA GPU' a.json || fail "the result file does not name the host"
    grep -q '"is_gpu": false' a.json || fail "the result file calls the host a GPU"
    expect 77 bulb openacc --device 1 --output b.png
    says 'there is no device 1'
    expect 0 bulb auto --output c.png --stats c.json
    says '^drawing with openmp \(no NVIDIA GPU here\)$'
    grep -q '"backend": "openmp"' c.json || fail "auto took another backend than openmp"
}

# --device selects the device; the OpenACC library's environment variable does not.
test_device_number() {
    local number
    for number in 0 1; do ACC_DEVICE_NUM=$number expect 0 bulb openacc --output $number.bmp; done
    same_picture 0.bmp 1.bmp
}
