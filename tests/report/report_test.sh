#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# report_test.sh SOURCE NAME BIN: runs one of the report's tests (figures, parts, report). Exits with 77 if the
# report's Python packages, which `make python` installs, are missing.
set -euo pipefail
cd "$1"
python=build/venv/bin/python3
if ! [ -x $python ] || ! $python -c 'import matplotlib, jinja2, PIL, scipy' 2>/dev/null; then
    echo "no build/venv with the report's packages: make python"
    [ -n "${MANDELMARCH_NEED_PYTHON:-}" ] && exit 1
    exit 77
fi
export PATH=$3:$PATH  # the tests find bench there
exec $python "tests/report/$2_test.py"
