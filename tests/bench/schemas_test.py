#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""schemas_test.py BIN SOURCE: the stored results, the files that bench writes, and what `bench json` prints of both
follow the schema that `bench schema` prints for their kind. A file that lacks a required key, or has a value of another
type, does not."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

BIN, SOURCE = map(pathlib.Path, sys.argv[1:3])
try:
    import jsonschema_rs
except ImportError as error:
    pinned = SOURCE / "build" / "venv" / "bin" / "python3"
    if pinned.exists() and sys.prefix == sys.base_prefix:
        os.execv(pinned, [pinned, *sys.argv])
    print(f"skipped: {error}; the pinned packages have it (make python)", file=sys.stderr)
    sys.exit(1 if os.environ.get("MANDELMARCH_NEED_PYTHON") else 77)


def bench(*words, codes=(0,)):
    # Other backends' files follow the same schemas, and their compilers take seconds.
    environment = os.environ | {"MANDELMARCH_BACKENDS": "openmp"}
    done = subprocess.run(list(map(str, (BIN / "bench", *words))), capture_output=True, text=True, env=environment)
    assert done.returncode in codes, f"{words}: {done.returncode}: {done.stderr}"
    return done.stdout


KINDS = ("equivalence", "portability", "random", "result")
SCHEMAS = {kind: json.loads(bench("schema", kind)) for kind in KINDS}
BY_NAME = {schema["properties"]["schema"]["const"]: kind for kind, schema in SCHEMAS.items() if "properties" in schema}


def validator(kind):
    return jsonschema_rs.Draft202012Validator(SCHEMAS[kind])


def check(name, data):
    kind = "portability" if isinstance(data, list) else BY_NAME[data["schema"]]
    error = next(validator(kind).iter_errors(data), None)
    assert error is None, f"{name}: no {kind}: {'/'.join(map(str, error.instance_path))}: {error.message[:200]}"
    return kind


def write_files(folder):
    """Runs bench and writes a file of each kind."""
    small = "--backend", "openmp", "--fractal", "box", "--size", "32x32", "--precision", "float", "--repetitions", 1
    results = SOURCE / "results"
    bench("random", "--scenes", 1, "--sets", 1, "--json", folder / "random.json", codes=(0, 1))
    bench("equivalence", "--backend", "openmp", "--scenes", 2, "--json", folder / "equivalence.json")
    bench("portability", results / "bench.json", results / "targets.json", "--json", folder / "portability.json")
    bench(*small, "--json", folder / "result.json")


seen = {}
with tempfile.TemporaryDirectory() as temporary:
    write_files(pathlib.Path(temporary))
    for path in [*sorted((SOURCE / "results").rglob("*.json")), *sorted(pathlib.Path(temporary).rglob("*.json"))]:
        data = json.loads(path.read_text())
        if isinstance(data, list) or data.get("schema") in BY_NAME:
            seen[check(path, data)] = data
            if isinstance(data, dict):
                check(f"bench json {path}", json.loads(bench("json", path)))
assert sorted(seen) == sorted(KINDS), f"no file of a kind: {seen.keys()}"
for kind, data in seen.items():  # negative controls
    whole = data[0] if isinstance(data, list) else data
    wrong = [whole | {key: [None]} for key in whole] + [{k: v for k, v in whole.items() if k != key} for key in SCHEMAS[kind].get("required", ())]
    for changed in wrong:
        assert not validator(kind).is_valid([changed] if isinstance(data, list) else changed), f"{kind}: {changed}"
print("fine:", ", ".join(sorted(seen)))
