#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# race_test.sh BIN: runs `bench race` with a correct serial program (racer.cpp) and with faulty ones.
set -euo pipefail
bench=$1/bench
. "$(dirname "$0")/expect.sh"
mkdir tmp
export TMPDIR=$work/tmp
# says PROGRAM PATTERN: checks the program's line of the table.
says() { grep -q -- "^\./$1  *$2" out || { cat out err >&2; fail "$1 is not '$2'"; }; }

faults=(nearly wrong size silent elsewhere text fails crashes hangs forks)
cp "$1/bench_racer" racer
for fault in right "${faults[@]}"; do
    printf '#!/bin/sh\nRACER=%s exec %s "$1"\n' "${fault/right/}" "$work/racer" >"$fault"
    chmod +x "$fault"
done
# Makes a program that writes a wrong picture from its fourth run on.
cat >unsteady <<SH
#!/bin/sh
echo run >>$work/runs
[ \$(wc -l <$work/runs) -gt 3 ] && export RACER=wrong
exec $work/racer "\$1"
SH
chmod +x unsteady
# Makes a program that keeps the correct picture of its first run and only copies it in later runs.
cat >stale <<SH
#!/bin/sh
[ -e $work/kept.bmp ] || { $work/racer "\$1" && mv image.bmp $work/kept.bmp; }
cp $work/kept.bmp image.bmp
SH
chmod +x stale
printf 'neither a program nor a script' >nothing
chmod +x nothing
few=(--fractal box --size 60x40 --repetitions 6)

# A correct program is timed. A program whose picture differs slightly is timed, too, and its line of the table says how
# many pixels differ.
expect 0 race ./right ./nearly "${few[@]}" --json right.json
grep -q '^mandelmarch openmp  *same bytes .*\] .*\] .* 0$' out || fail "$(cat out)"
says right '\(same bytes\|0.000 % off\) .*\] .*\] .* 0$'
says nearly '[0-9.]* % off .* 0$'

# The table names the fault of each faulty program and gives the program no speed. mandelmarch itself gets a speed.
expect 1 race "${faults[@]/#/./}" ./unsteady ./stale ./nothing "${few[@]}" --limit 3 --json faults.json
says wrong 'WRONG  *[0-9]* of 2400 pixels differ, [0-9]* visibly, the first at [0-9]*,[0-9]*$'
says size 'WRONG SIZE  *61 x 40 pixels, expected 60 x 40$'
says silent 'NO PICTURE  *no image.bmp$'
says elsewhere 'NO PICTURE  *no image.bmp, but other.bmp$'
says text 'NO IMAGE FILE  *image.bmp: '
says fails 'FAILED  *exit code 3: racer: I cannot$'
says crashes 'CRASHED  *ended by signal 11, '
says hangs 'HUNG  *no end within 3 s$'
says forks 'HUNG'
says unsteady 'UNSTEADY  *round [0-9], another view: [0-9]* of 2400 pixels differ'
says stale 'UNSTEADY  *round 0, another view: [0-9]* of 2400 pixels differ'
says nothing 'NO START  *does not start: '
python3 - "$bench" <<'PY'
import json
import subprocess
import sys
right, faults = (json.loads(subprocess.check_output([sys.argv[1], "json", name + ".json"]))["programs"] for name in ("right", "faults"))
assert all(len(p["samples"]) == 6 and p["wall"]["median"] > 0 and p["memory"] > 1e6 for p in right), right
assert right[0]["ours"] and right[0]["times_ours"] == 1 and not right[1]["ours"]
assert right[1]["picture"]["visibly_differing"] == 0 and right[1]["picture"]["differing"] < right[2]["picture"]["differing"]
assert right[2]["picture"]["first_x"] >= 0
ours, *others = faults
assert ours["wall"] and len(others) == 13
for p in others:
    timed = p["name"] == "./nearly"
    assert (p["wall"] is not None) == timed and (p["times_ours"] is not None) == timed and bool(p["samples"]) == timed, p
assert [p["signal"] for p in others if p["name"] == "./crashes"] == [11]
assert [p["exit_code"] for p in others if p["name"] == "./fails"] == [3]
PY

# Tests wrong arguments of race.
refused 'nosuch: no program' race ./nosuch
expect 2 race
expect 2 race ./right --csv x.csv
expect 2 race ./right --scene nosuch.dat --fractal box
refused 'without --fractal' race ./right --scene right
expect 2 race ./right --json right
grep -q exec right || fail "a race wrote over a program"
expect 1 race ./right "${few[@]}" --backend nosuch
grep -q '^mandelmarch nosuch  *FAILED  *exit code 2' out || fail "$(cat out)"

# No temporary folder and no process of a program remains.
[ -z "$(ls tmp)" ] || fail "left in the temporary folder: $(ls tmp)"
! pgrep -f "$work/racer" >/dev/null || fail "a program still runs"
echo fine
