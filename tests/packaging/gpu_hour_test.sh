#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# gpu_hour_test.sh BUILD SOURCE: the first hour on a GPU, rehearsed: every step passes, can be left out and done again, and
# says that it is a rehearsal. The twin: other hashes.
set -uo pipefail
source=$(realpath "$2")
. "$source/tests/failures.sh"
cp "$source"/params*.dat "$folder"
mkdir "$folder/bin" "$folder/gpu-hour"
for program in render bench flythrough imgdiff; do cp "$1/bin/$program" "$folder/bin"; done
cp "$source"/packaging/gpu_hour* "$folder/gpu-hour"
cd "$folder"
hour() { MANDELMARCH_REHEARSAL=1 BACKENDS=vulkan gpu-hour/gpu_hour bin results "$@" >out 2>&1; }

# Where nothing is taken for a GPU, it stops with a line and says where.
BACKENDS=vulkan gpu-hour/gpu_hour bin results devices >out 2>&1
[ $? = 1 ] && grep -q '^devices: FAILED.*no backend sees a GPU' out || fail "without a GPU: $(cat out)"

# Stopped, it leaves no process, and no step that did not pass.
MANDELMARCH_REHEARSAL=1 BACKENDS=vulkan gpu-hour/gpu_hour bin results >out 2>&1 &
for _ in $(seq 300); do
    compgen -G 'results/rehearsal-*/speed.log' >/dev/null && break
    sleep 0.1
done
kill $! && wait $!
[ $? = 130 ] || fail "stopped, it ends with another exit code than 130"
sleep 1
pgrep -f "$folder/bin" >processes && fail "stopped, it leaves $(cat processes)"

hour || fail "a step failed: $(cat out)"
grep -q 'devices: done before' out || fail "stopped, it does not go on: $(cat out)"
in=$(echo results/rehearsal-*)
grep -q "^skipped" "$in/kernels.status" || fail "kernels of no GPU: $(cat "$in/kernels.log")"
for step in machine devices bits fast speed large bands frames; do
    grep -q '^passed' "$in/$step.status" || fail "$step: $(tail -5 "$in/$step.log")"
done
head -1 "$in/README.md" | grep -q REHEARSAL || fail "the page does not say that it is a rehearsal"
for result in "$in"/540-vulkan.json "$in"/bands-vulkan.json; do
    grep -q '"a rehearsal: ' "$result" || fail "$result does not say that it is a rehearsal"
done
grep -q '^| bits | passed' "$in/README.md" || fail "the page has no bits: $(cat "$in/README.md")"

# It goes on: what passed is not done again, but for steps that are named.
echo FAILED >"$in/fast.status"
hour || fail "going on: $(cat out)"
[ "$(grep -c 'done before' out)" -ge 7 ] && grep -q '^fast: passed' out || fail "going on did: $(cat out)"
hour nonsense && fail "a step that is none"
grep -q "'nonsense' is no step" out || fail "of a step that is none it says: $(cat out)"

sed -i 's/^./x/; s/^x\(.\)/\1\1/' gpu-hour/gpu_hour.sha256
hour bits && fail "other hashes are not seen"
grep -q 'OTHER BITS' "$in/bits.log" || fail "the log of other hashes: $(cat "$in/bits.log")"
finish
