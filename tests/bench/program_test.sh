#!/usr/bin/env bash
# program_test.sh BIN SOURCE: the program bench from outside: exit codes, files, launches, two runs of one build.
set -euo pipefail
bench=$1/bench
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; exit 1; }
# expect CODE ARGUMENT...
expect() {
    local code=$1 got=0
    shift
    "$bench" "$@" >out 2>err || got=$?
    [ "$got" = "$code" ] || { cat out err >&2; fail "bench $* exited with $got, expected $code"; }
}
quick=(--backend openmp --size 64x64 --precision float --repetitions 6)

expect 0 "${quick[@]}" --json a.json --csv a.csv --launches 3
grep -q '^openmp\|^bulb' out || fail "no table"
grep -q '"launches": 3' a.json || fail "three launches are not in the result"
[ "$(grep -c '"launch": 2' a.json)" -gt 0 ] || fail "no samples of the third launch"
head -1 a.csv | grep -q '^problem,application,platform,fom,' || fail "CSV columns"

# Two runs of one build: compare works; on a shared machine whatever it says of single rows, it must not fail otherwise.
expect 0 "${quick[@]}" --json b.json --launches 3
code=0
"$bench" compare a.json b.json >out || code=$?
[ "$code" -le 1 ] || fail "compare exited with $code"
grep -q 'no difference\|faster\|SLOWER' out || fail "compare printed no verdict"
expect 0 compare a.json a.json
# A regression: the launches' times made even, and then doubled.
python3 - <<'PY'
import json
result = json.load(open('a.json'))
for name, seconds in ('even', 0.1), ('slow', 0.2):
    for row in result['rows']:
        for sample in row['samples']:
            sample['kernel'] = seconds * (1 + 0.002 * sample['launch'])
    json.dump(result, open(name + '.json', 'w'))
PY
expect 1 compare even.json slow.json
grep -q SLOWER out || fail "no SLOWER in a comparison with doubled times"
expect 0 compare slow.json even.json
grep -q faster out || fail "no faster in a comparison with halved times"

expect 0 portability a.json b.json
grep -q mandelbox out || fail "no portability"
expect 0 --list
grep -q box-vs-bulb out || fail "--list shows no studies"
expect 0 --benchmark_list_tests
expect 0 --help
# Data on standard output stand alone.
expect 0 "${quick[@]}" --fractal box --json -
python3 -c 'import json; json.load(open("out"))' || fail "--json - prints more than JSON"
expect 0 "${quick[@]}" --fractal box --benchmark_format=csv --benchmark_out=g.json
python3 -c 'import json; assert json.load(open("g.json"))["benchmarks"]' || fail "--benchmark_out"
expect 0 "${quick[@]}" --study profile --repetitions 1 --wide
grep -q march out || fail "no profile"
expect 0 "${quick[@]}" --study box-vs-bulb --repetitions 1 --json study.json
grep -q angles out || fail "no trigonometric Mandelbulb"

expect 0 random --scenes 3 --sets 1001,77 --json random.json
grep -q ' of 6 ' out || fail "random has no line of six scenes"
python3 -c 'import json; assert len(json.load(open("random.json"))["scenes"]) == 24' || fail "random --json"
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

expect 2 --nosuch
expect 2 --size 10
expect 2 compare a.json
expect 2 compare a.json nosuch.json
echo '{"schema": "mandelmarch-bench", "version": 99}' >future.json
expect 2 compare a.json future.json
grep -q 'version 99' err || fail "the version is not named"
expect 1 "${quick[@]}" --fractal box --json /dev/full
echo "not JSON" >bad.json
expect 2 portability bad.json

# The schema, where the pinned Python package is installed (make python).
python=$source/build/venv/bin/python3
if [ -x "$python" ] && "$python" -c 'import jsonschema' 2>/dev/null; then
    "$python" - "$source/bench/result.schema.json" a.json study.json <<'PY'
import json, sys, jsonschema
schema = json.load(open(sys.argv[1]))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for path in sys.argv[2:]:
    validator.validate(json.load(open(path)))
# The twin: what the schema must refuse.
def refused(change):
    result = json.load(open(sys.argv[2]))
    change(result)
    return not validator.is_valid(result)
assert refused(lambda r: r['rows'][0].pop('samples'))
assert refused(lambda r: r['rows'][0]['proof'].update(fine=False)), 'a wrong picture with a speed'
assert refused(lambda r: r.update(version=2))
assert refused(lambda r: r.update(extra=1))
PY
else
    echo "the schema is not checked: run make python" >&2
    [ -z "${MANDELMARCH_NEED_PYTHON:-}" ] || exit 1
fi
echo fine
