#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program_test.sh BIN SOURCE: the programs without a GPU report that the host renders, and reject a missing GPU.
# Pictures are tested in tests/models.
set -uo pipefail
backend=openacc bin=$1 source=$2
. "$source/tests/openacc/simulated.sh"
export CUDA_VISIBLE_DEVICES=  # hides any GPU

expect 0 1 '^backend openacc: runs on the host, one thread: no NVIDIA GPU' --output a.png --stats a.json
grep -q '"name": "host, one thread: no NVIDIA GPU' a.json || fail "the result file does not name the host"
grep -q '"is_gpu": false' a.json || fail "the result file calls the host a GPU"
expect 77 1 'there is no device 1' --device 1 --output b.png
[ -e b.png ] && fail "a picture from a device that is not there"
backend=auto expect 0 1 '^backend openmp: openacc has no GPU' --output c.png --stats c.json
grep -q '"backend": "openmp"' c.json || fail "auto took another backend than openmp"
finish
