# SPDX-License-Identifier: Apache-2.0
# For tests that are shell scripts, which source it: an empty folder, gone at the end, and failures that are counted.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
# The last line of a test.
finish() {
    [ $failures = 0 ] && echo "all well"
    exit $((failures > 0))
}
