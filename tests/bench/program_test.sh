#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program_test.sh BIN SOURCE: runs bench and checks exit codes, files, studies of several processes, and the comparison
# of two results of one build.
set -euo pipefail
bench=$1/bench
source=$2
. "$(dirname "$0")/expect.sh"
quick=(--backend openmp --size 64x64 --precision float --repetitions 6 --no-peaks)

# If sources are not committed, bench refuses to write into the project's folder of results.
if "$bench" --version | grep -q changed; then
    refused 'sources that no commit has' "${quick[@]}" --json "$source/results/of-no-commit.json"
fi

expect 0 "${quick[@]}" --json a.json --csv a.csv --runs 3
! grep -q '^peak, ' out || fail "a peak that was not asked for"
grep -q '^openmp\|^bulb' out || fail "no table"
grep -q '^scene precision mode ' out || fail "the table has no heads"
grep -q '^mandelbulb float fast: openmp [wl].* times as fast as openmp-scalar' out || fail "no winner"
tail -1 out | grep -q ' processors were free: ' || fail "the last line: $(tail -1 out)"
grep -q '"runs": 3' a.json || fail "three runs are not in the result"
[ "$(grep -c '"run": 2' a.json)" -gt 0 ] || fail "no samples of the third run"
head -1 a.csv | grep -q '^problem,application,platform,fom,' || fail "CSV columns"

# Compares two results of one build. On a shared machine, compare may report a difference, with exit code 1. Any other
# failure is a fault.
expect 0 "${quick[@]/--no-peaks/--peaks}" --json b.json
grep -q '^peak, ' out || fail "no peak"
code=0
"$bench" compare a.json b.json >out || code=$?
[ "$code" -le 1 ] || fail "compare exited with $code"
grep -q '^verdicts: .*\(same\|undecided\|faster\|SLOWER\)' out || fail "compare printed no verdict"
expect 0 compare a.json a.json
# Makes two results from one: one with equal times, and one with doubled times, which is a regression.
python3 - <<'PY'
import json
result = json.load(open('a.json'))
for name, seconds in ('even', 0.1), ('slow', 0.2):
    for row in result['rows']:
        for sample in row['samples']:
            sample['kernel'] = seconds * (1 + 0.002 * sample['run'])
    json.dump(result, open(name + '.json', 'w'))
PY
expect 1 compare even.json slow.json
grep -q SLOWER out || fail "no SLOWER in a comparison with doubled times"
expect 0 compare slow.json even.json
grep -q faster out || fail "no faster in a comparison with halved times"

expect 0 portability a.json b.json --csv p3.csv
grep -q mandelbox out || fail "no portability"
grep -q '^mandelbox float exact 64x64,openmp,' p3.csv || fail "portability --csv"
grep -q reference p3.csv && fail "the reference is an application"
# Files in a folder that are not results of a study are left out, with a message.
mkdir -p folder/below
cp a.json folder/
cp b.json folder/below/
echo '{"schema": "mandelmarch-lines-of-code"}' >folder/lines_of_code.json
expect 0 portability folder
grep -q mandelbox out || fail "no portability of a folder"
[ "$(cat err)" = "bench: folder/lines_of_code.json: no result of bench, left out" ] || fail "$(cat err)"
grep -q '^H, the set of platforms:$' out || fail "H is not named"
sed 's/"revision": [^,]*/"revision": "0123abcdef"/' a.json >folder/other.json
expect 0 portability folder
grep -q '^bench: warning: these results are of different revisions: .*0123abcd' err || fail "revisions that differ: $(cat err)"
rm folder/other.json
sed 's/"mode": "exact"/"mode": 7/' a.json >folder/damaged.json
expect 2 portability folder
grep -q 'damaged.json: .*mode: 7 given' err || fail "a damaged result is left out"
expect 2 portability folder/lines_of_code.json

cp a.json kept.json
expect 2 portability a.json --json a.json
cmp a.json kept.json || fail "portability wrote over what it reads"
expect 0 csv a.json
cmp out a.csv || fail "csv makes other lines than --csv"

# Outputs that cannot be written are refused before anything is measured. If an output fails later, the others are
# written.
expect 2 "${quick[@]}" --json nosuch/x.json
! grep -q verif err || fail "measured for a file that cannot be written"
expect 2 "${quick[@]}" --json - --csv -
expect 2 "${quick[@]}" --json /tmp
expect 2 "${quick[@]}" --json x.json --csv x.json
expect 2 "${quick[@]}" --json .
expect 1 "${quick[@]}" --fractal box --json /dev/full --csv full.csv
grep -q '^box' out || fail "no table beside a full disk"
[ "$(wc -l <full.csv)" -gt 1 ] || fail "no CSV beside a full disk"
[ "$(grep -c /dev/full err)" = 1 ] || fail "the full disk is not named once"
# If the reader of a pipe closes the pipe, bench prints no message and exits as if the output had been read.
unread() { { sleep 0.1; got=0; "$bench" "$@" 2>err || got=$?; echo $got >code; } | true; }
unread csv a.json
[ "$(cat code)" = 0 ] && [ ! -s err ] || fail "a pipe that nobody reads: $(cat code err)"
unread compare even.json slow.json
[ "$(cat code)" = 1 ] && [ ! -s err ] || fail "a regression that nobody reads: $(cat code err)"
# If a run is killed, only its own samples are lost.
"$bench" "${quick[@]}" --fractal box --runs 3 --json killed.json >out 2>err &
killer=$!
until victim=$(pgrep -P $killer -f -- '--run 1$'); do
    kill -0 $killer 2>/dev/null || fail "no run to kill"
    sleep 0.01
done
kill -9 "$victim"
code=0
wait $killer || code=$?
[ "$code" = 1 ] || fail "a killed run: exit code $code"
grep -q '^bench: run 1 ended with 137' err || fail "the killed run is not named"
grep -q '"runs": 2' killed.json || fail "the runs that are left"
grep -q '"run 1 ended with 137"' killed.json || fail "no warning in the result"
grep -q '"run": 2' killed.json || fail "the third run is lost"
grep -q '^box' out || fail "no table"

expect 0 --list
grep -q box-vs-bulb out || fail "--list shows no studies"
expect 0 --list --study resolution --backend openmp,opencl
grep -q /openmp/ out && grep -qE '/opencl/|^opencl: ' out || fail "two backends: $(cat out)"
grep -qE 'vulkan|stdpar' out && fail "a backend that nobody asked for: $(cat out)"
refused "^--backend: 'nosuch' given" --list --backend openmp,nosuch
expect 0 --help
# If data is written to standard output, messages and tables are not.
expect 0 "${quick[@]}" --fractal box --json -
python3 -c 'import json; json.load(open("out"))' || fail "--json - prints more than JSON"
expect 0 "${quick[@]}" --study box-vs-bulb --repetitions 1 --json study.json
grep -q angles out || fail "no trigonometric Mandelbulb"
expect 0 --size 32x32 --fractal box --study ladder --repetitions 2
[ "$(grep -c "^mandelbox  *rung=" out)" = 7 ] && grep -q "all together" out || fail "the ladder has not seven rungs: $(cat out)"

expect 0 random --scenes 3 --sets 1001,77 --json random.json
grep -q ' of 6 ' out || fail "random has no line of six scenes"
python3 -c 'import json; assert len(json.load(open("random.json"))["scenes"]) == 24' || fail "random --json"
# An option before a command is an error. It is not ignored.
refused '^bench: --backend before peak given' --backend openmp peak
expect 2 random --backend nosuch
expect 2 random --scenes 0
expect 2 random --sets one

expect 0 equivalence --backend openmp --scenes 6 --json equivalence.json
grep -q '^openmp  *0 .* float .* 6 ' out || fail "equivalence has no line of six pictures"
python3 -c 'import json; assert all(s["wrong"] == 0 for s in json.load(open("equivalence.json"))["subjects"])' ||
    fail "equivalence --json"
expect 2 equivalence --backend nosuch
expect 2 equivalence --fractal nosuch
expect 2 equivalence --scenes 0

expect 2 compare a.json
expect 2 compare a.json nosuch.json
echo '{"schema": "mandelmarch-bench", "version": 99}' >future.json
refused 'version 99' compare a.json future.json
echo "not JSON" >bad.json
expect 2 portability bad.json
python3 -c 'print("{\"version\": " + 300000 * "[")' >deep.json
refused nested compare a.json deep.json
refused nested portability deep.json

echo fine
