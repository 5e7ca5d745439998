#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# programs_test.sh BIN: measures a correct serial program (made_program.cpp), faulty ones, and `render`, as backends.
set -euo pipefail
bench=$1/bench
. "$(dirname "$0")/expect.sh"
mkdir tmp
export TMPDIR=$work/tmp
# says PROGRAM PATTERN: checks the line on stderr that says why the program failed.
says() { grep -- "/program:./$1/0: " err | grep -q -- "$2" || { cat out err >&2; fail "$1 is not '$2'"; }; }

faults=(nearly wrong size silent elsewhere text fails crashes hangs forks)
cp "$1/bench_made_program" made_program
for fault in right "${faults[@]}"; do
    printf '#!/bin/sh\nMADE_FAULT=%s exec %s "$1"\n' "${fault/right/}" "$work/made_program" >"$fault"
    chmod +x "$fault"
done
# Makes a program that keeps the correct picture of its first run and only copies it in later runs.
cat >stale <<SH
#!/bin/sh
[ -e $work/kept.bmp ] || { $work/made_program "\$1" && mv image.bmp $work/kept.bmp; }
cp $work/kept.bmp image.bmp
SH
# Makes a program that leaves a folder without rights, and a process of a session of its own.
cat >litter <<SH
#!/bin/sh
mkdir -m 000 kept
setsid sleep 1000.25 >/dev/null 2>&1 &
exec $work/made_program "\$1"
SH
chmod +x stale litter
few=(--fractal box --size 60x40 --precision double --mode exact --repetitions 6 --no-peaks)
# Joins the programs' names as backends.
backends() { local IFS=,; echo "${*/#/program:./}"; }

# A correct program is timed. A program whose picture differs slightly is timed, too, and its line of the table says how
# many pixels differ. All exit codes are seen if the caller ignores the signal of ended children.
expect 0 --backend "openmp,$(backends right nearly litter)" "${few[@]}" --json right.json
grep -q 'program\[1\]  *0 \(same bytes\|0.000 % off\) .*\]' out || fail "$(cat out)"
grep -q 'program\[2\]  *0 [0-9.]* % off .*\]' out || fail "$(cat out)"
grep -q '^program\[2\] 0: program:./nearly, ' out || fail "$(cat out)"
pgrep -f 'sleep 1000.25' >/dev/null && fail "a process of a program still runs"
[ -z "$(ls tmp)" ] || fail "left in the temporary folder: $(ls tmp)"

# A program that keeps the picture of the scene before replays only the scene's own view, which is not timed.
cat >keeps <<SH
#!/bin/sh
if cmp -s scene.dat $work/last.dat; then md5sum scene.dat >>$work/hits; cp $work/last.bmp image.bmp; exit; fi
$work/made_program "\$1" && cp scene.dat $work/last.dat && cp image.bmp $work/last.bmp
SH
chmod +x keeps
expect 0 --backend "$(backends keeps)" "${few[@]}"
[ ! -e hits ] || [ "$(sort -u hits | wc -l)" = 1 ] || fail "a timed picture was replayed: $(cat hits)"

# Each faulty program has no speed, and its line says why; openmp has one.
MANDELMARCH_DEVICE_TIMEOUT=3 expect 1 --backend "openmp,$(backends "${faults[@]:1}" stale)" "${few[@]}" --json faults.json
says wrong '[0-9]* of 2400 pixels differ'
says size '61 x 40 pixels, expected 60 x 40'
says silent 'no image.bmp'
says elsewhere 'no image.bmp'
says text 'image.bmp: '
says fails 'exit code 3.*made_program: I cannot'
says crashes 'signal 11'
says hangs 'no end within 3 s'
says forks 'no end within 3 s'
says stale 'a view nearby is wrong'
env --ignore-signal=CHLD "$bench" --backend "$(backends fails)" "${few[@]}" >out 2>err && fail "a program that fails passes"
says fails 'exit code 3'
python3 - <<'PY'
import json
right, faults = (json.load(open(name + ".json"))["rows"] for name in ("right", "faults"))
for row in right:
    assert row["samples"], row
assert json.load(open("right.json"))["moved_eye"]
for row in faults:
    assert bool(row["samples"]) == (not row["backend"].startswith("program:")), row
PY

# `render` is not foreign: it is measured in each precision and mode, and its exact pictures have the same bits or, in
# double, bytes.
expect 0 --backend "program:$1/render --threads 1" --fractal box --size 60x40 --repetitions 2 --no-peaks
for same in bits bytes; do
    [ "$(grep -c "program\[1\] .* same $same " out)" = 1 ] || { cat out >&2; fail "one row of the same $same"; }
done

# Without a technique, render's pictures are others. A foreign program has none to leave out, and its failed trial is said.
expect 0 --study ablation --mode fast --backend "program:$1/render --threads 1" --fractal box --size 60x40 \
    --precision double --repetitions 1 --no-peaks --json ablation.json
expect 0 --study ablation --mode fast --backend "$(backends right)" --fractal box --precision double --list
grep -q 'right/0/without=none$' out && ! grep -q 'right/0/without=hull' out || fail "$(cat out)"
grep -q '^program:./right: .*timed as a whole process' err || fail "$(cat err)"
python3 - <<'PY'
import json
rows = [row for row in json.load(open("ablation.json"))["rows"] if row["samples"]]
off = {row["sweep_value"]: row["verification"]["visibly_differing"] for row in rows if "render" in row["backend"]}
assert len(off) > 5 and len(set(off.values())) > 1, off
PY

# The statistics of a program are checked. A signal that ends bench ends every process that the program started.
printf '#!/bin/sh\n%s "$@" && rm -f stats.json && mkfifo stats.json\n' "$1/render" >lies
printf '#!/bin/sh\nsetsid sleep 1000.75 & sleep 1000.5\n' >stays
chmod +x lies stays
expect 1 --backend "$(backends lies)" "${few[@]}"
"$bench" --backend "$(backends stays)" "${few[@]}" >out 2>err &
while ! pgrep -f 'sleep 1000.75' >/dev/null; do sleep 0.1; done
kill -TERM $!
wait $! && fail "an ended bench succeeded"
sleep 0.2
pgrep -f 'sleep 1000' >/dev/null && fail "a process still runs after a signal"
[ -z "$(ls tmp)" ] || fail "left in the temporary folder: $(ls tmp)"

# says_last PATTERN ARGUMENT...: bench exits with 2, and its last line on stderr matches PATTERN.
says_last() { expect 2 "${@:2}"; tail -n 1 err | grep -q -- "$1" || fail "$1 expected in: $(cat err)"; }
refused 'nosuch.*expected an executable' --backend program:./nosuch
says_last 'right.*same file' --backend program:./right --fractal box --json right
refused 'whose scenes differ' --study box-vs-bulb --fractal box --scene right --backend openmp
says_last 'a backend of this build' equivalence --backend program:./right
refused 'json excludes --list' --list --json x.json
says_last 'without --fractal' --backend program:./right --scene right
expect 2 --backend program:./right --fractal box --scene nosuch.dat
! pgrep -f "$work/made_program" >/dev/null || fail "a program still runs"
echo fine
