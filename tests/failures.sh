# SPDX-License-Identifier: Apache-2.0
# Sourced by tests in shell: creates an empty folder, deleted on exit, and counts failures.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
# Reports the result and sets the exit code. Must be the last command of a test.
finish() {
    [ $failures = 0 ] && echo "all well"
    exit $((failures > 0))
}
