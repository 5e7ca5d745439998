#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""schemas_test.py BIN SOURCE [FILE...]: the JSON files below SOURCE/results, the files that the programs write,
and each FILE follow the schema of their kind. Every schema rejects a file with a missing key, with an additional key,
or with a value of another type. `bench schema KIND` prints the stored schema."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema_rs
except ImportError as error:
    pinned = pathlib.Path(sys.argv[2], "build", "venv", "bin", "python3")
    if pinned.exists() and sys.prefix == sys.base_prefix:
        os.execv(pinned, [pinned, *sys.argv])
    print(f"skipped: {error}; the report's pinned packages have it (make python)", file=sys.stderr)
    sys.exit(1 if os.environ.get("MANDELMARCH_NEED_PYTHON") else 77)

BIN, SOURCE = map(pathlib.Path, sys.argv[1:3])
PATHS = {path.name.removesuffix(".schema.json"): path for path in (SOURCE / "bench" / "schemas").glob("*.schema.json")}
SCHEMAS = {kind: json.loads(path.read_text()) for kind, path in PATHS.items()}
REGISTRY = jsonschema_rs.Registry([(schema["$id"], schema) for schema in SCHEMAS.values()])
BY_NAME = {
    "mandelmarch-bench": "result", "mandelmarch-bench-random": "random", "mandelmarch-duel": "duel",
    "mandelmarch-bench-equivalence": "equivalence", "mandelmarch-film": "film", "mandelmarch-race": "race",
}
GENERATED = ("duel", "equivalence", "portability", "race", "random", "result")


def kind_of(data):
    """Returns the name of the schema for a file with the content `data`."""
    if isinstance(data, list):
        return "portability"
    if "format" in data:
        return "map"
    if data["schema"] != 1:
        return BY_NAME[data["schema"]]
    return "audit" if "promises_kept" in data else "demo" if "repetitions" in data else "stats"


def validator(kind):
    return jsonschema_rs.Draft202012Validator(SCHEMAS[kind], registry=REGISTRY)


def check(name, data):
    kind = kind_of(data)
    error = next(validator(kind).iter_errors(data), None)
    assert error is None, f"{name}: no {kind}: {'/'.join(map(str, error.instance_path))}: {error.message[:200]}"
    return kind


def check_negative_controls(kind, data):
    """Negative control: a file with a missing or an additional key, or a value of another type, must not follow the
    schema."""
    whole = data[0] if isinstance(data, list) else data

    def refused(changed):
        return not validator(kind).is_valid([changed, *data[1:]] if isinstance(data, list) else changed)

    for key in whole:
        without = {other: value for other, value in whole.items() if other != key}
        assert refused(without) or key == "winners", f"{kind} without {key}"  # results of older builds have no winners
        assert refused(whole | {key: [None]}), f"{kind} with a list as {key}"
    assert refused(whole | {"nosuch": 1}), f"{kind} with a key too many"


def run(*words):
    # Other backends' files follow the same schemas, and their compilers take seconds.
    environment = os.environ | {"MANDELMARCH_BACKENDS": "openmp"}
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, env=environment)
    assert done.returncode in (0, 1), f"{words}: {done.returncode}: {done.stderr}"


def written(folder):
    """Runs the programs and returns the files that they write."""
    results = SOURCE / "results"
    bench = BIN / "bench"
    run(bench, "random", "--scenes", 1, "--sets", 1, "--json", folder / "random.json")
    run(bench, "equivalence", "--backend", "openmp", "--scenes", 2, "--json", folder / "equivalence.json")
    run(bench, "portability", results / "bench.json", results / "targets.json", "--json", folder / "portability.json")
    run(bench, "--backend", "openmp", "--fractal", "box", "--size", "32x32", "--precision", "float", "--repetitions", 1,
        "--json", folder / "result.json")
    run(bench, "duel", bench, bench, "--backend", "openmp", "--fractal", "box", "--size", "32x32", "--precision", "float",
        "--runs", 2, "--repetitions", 1, "--json", folder / "duel.json")
    run(bench, "race", BIN / "bench_racer", "/bin/false", "--fractal", "box", "--size", "32x32", "--repetitions", 1, "--json",
        folder / "race.json")
    run(BIN / "mandelbox", SOURCE / "paramsBox.dat", "--size", "32x32", "--output", folder / "a.bmp", "--stats",
        folder / "stats.json")
    run(BIN / "demo", "--folder", folder / "demo", "--side", 32)
    return sorted(folder.rglob("*.json"))


for kind in GENERATED:
    printed = subprocess.run([BIN / "bench", "schema", kind], capture_output=True, text=True, check=True).stdout
    assert printed == PATHS[kind].read_text(), f"{PATHS[kind]} is not what bench schema {kind} prints"
for schema in SCHEMAS.values():
    jsonschema_rs.meta.validate(schema)
with tempfile.TemporaryDirectory() as folder:
    files = [*sorted((SOURCE / "results").rglob("*.json")), *map(pathlib.Path, sys.argv[3:])]
    seen = {}
    for path in [*files, *written(pathlib.Path(folder))]:
        data = json.loads(path.read_text())
        if "models" in data:  # lines of code, which have no schema
            continue
        seen[check(path, data)] = data
for kind, data in seen.items():
    check_negative_controls(kind, data)
unseen = set(SCHEMAS) - set(seen) - {"environment"}  # an environment is only a part of other files
assert not unseen, f"no file for the schemas of {unseen}"
print("fine:", ", ".join(sorted(seen)))
