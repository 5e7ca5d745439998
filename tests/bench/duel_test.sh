#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# duel_test.sh BIN: runs `bench duel` and checks exit codes, messages, and the verdict on a program that is ten times as
# slow.
set -euo pipefail
bench=$1/bench
. "$(dirname "$0")/expect.sh"
for percent in 0 900; do cp "$1/bench_slowed" "slowed_$percent"; done
rows=(--backend openmp --fractal box --precision float --size 64x48)
few=(--runs 4 --repetitions 4 --clock processor)

# A duel detects that the new program has ten times the work of the old one, and that it has a tenth of it.
expect 1 duel ./slowed_0 ./slowed_900 "${rows[@]}" "${few[@]}" --json slower.json
grep -q '^mandelbox/float/exact/openmp/0 .*SLOWER$' out || fail "$(cat out)"
expect 0 duel ./slowed_900 ./slowed_0 "${rows[@]}" "${few[@]}"
grep -q '^mandelbox/float/exact/openmp/0 .*faster$' out || fail "$(cat out)"
! grep -q reference out || fail "the expected picture is in a duel"

# In a duel of equal programs, every pair is measured. The verdicts are not checked, because other processes may disturb
# the measurement.
got=0
"$bench" duel ./slowed_0 ./slowed_0 "${rows[@]}" --runs 2 --repetitions 3 --json pairs.json >out 2>err || got=$?
[ "$got" -le 1 ] || fail "a duel of equal programs exited with $got: $(cat err)"
python3 - <<'PY'
import json
duel = json.load(open("pairs.json"))
assert duel["runs"] == 2 and duel["rounds"] == 3
for row in duel["rows"]:
    assert sorted((p["run"], p["round"]) for p in row["pairs"]) == [(l, r) for l in (0, 1) for r in range(3)], row["name"]
    assert row["same_picture"] and all(p["old"] > 0 and p["new"] > 0 for p in row["pairs"])
PY

# Tests programs that are not bench, and programs that die.
refused 'nosuch: no program' duel ./nosuch ./slowed_0
expect 2 duel ./slowed_0
expect 2 duel ./slowed_0 ./slowed_0 --csv x.csv
expect 2 duel ./slowed_0 ./slowed_0 --runs 1
expect 2 duel ./slowed_0 ./slowed_0 --margin -1
cp ./slowed_0 kept
expect 2 duel ./slowed_0 ./slowed_900 --json slowed_0
cmp slowed_0 kept || fail "a duel wrote over a program"
printf '#!/bin/sh\nexit 3\n' >refuses
printf '#!/bin/sh\nread line; exit 0\n' >silent
printf '#!/bin/sh\necho "no JSON" >&0; cat >/dev/null\n' >babbles
chmod +x refuses silent babbles
expect 1 duel ./refuses ./slowed_0 "${rows[@]}" --runs 2
grep -q 'the old program ended with 3' err || fail "$(cat err)"
expect 1 duel ./slowed_0 ./babbles "${rows[@]}" --runs 2
grep -q 'the new program does not answer as bench does' err || fail "$(cat err)"

# If a program is killed in a run, only the pairs of that run are lost. Programs of a duel run with a passive
# OMP_WAIT_POLICY, whatever value the user has set.
cat >dies_once <<'SH'
#!/bin/sh
echo "$OMP_WAIT_POLICY" >>policies
case "$*" in *--unproven*) echo start >>starts; [ "$(wc -l <starts)" != 2 ] || kill -9 $$ ;; esac
exec ./slowed_900 "$@"
SH
chmod +x dies_once
OMP_WAIT_POLICY=active expect 1 duel ./slowed_0 ./dies_once "${rows[@]}" --runs 4 --repetitions 4 --clock processor --json killed.json
grep -q 'the new program was ended by signal 9, the other runs are kept' err || fail "$(cat err)"
grep -q '"runs": 3' killed.json || fail "the runs that are left"
[ "$(sort -u policies)" = passive ] || fail "waiting threads: $(sort policies | uniq -c)"
echo fine
