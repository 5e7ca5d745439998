#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""kept_results_test.py BIN SOURCE: bench reads every stored result and derives from its samples the figures that the
result has. The last digits may differ, because other versions of libraries round differently. Results of older builds
lack the winners. No configuration exceeds the peak of its device."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

BIN, SOURCE = map(pathlib.Path, sys.argv[1:3])


def derived(path):
    return json.loads(subprocess.run([BIN / "bench", "json", path], capture_output=True, text=True, check=True).stdout)


def same(one, other):
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=1e-9)
    return one == other


checked = 0
for path in sorted((SOURCE / "results").rglob("*.json")):
    stored = json.loads(path.read_text())
    if isinstance(stored, dict) and stored.get("schema") == "mandelmarch-bench":
        found = derived(path)
        assert bool(found["winners"]) == (stored["study"] == "standard"), path
        assert same({"winners": found["winners"]} | stored, found), f"{path}: bench json gives other values"
        for row in stored["rows"]:
            assert ((row["figures"] or {}).get("share_of_peak") or 0) <= 1, f"{path}: {row['name']} exceeds the peak"
        checked += 1
assert checked > 20, checked

# Negative control: if a sample differs, so do the figures.
changed = json.loads((SOURCE / "results" / "bench.json").read_text())
row = next(row for row in changed["rows"] if row["figures"])
for sample in row["samples"]:
    sample["kernel"] *= 2
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder, "changed.json")
    path.write_text(json.dumps(changed))
    found = derived(path)
    assert not same({key: found[key] for key in changed}, changed), "figures are copied, not derived"
print(f"{checked} results")
