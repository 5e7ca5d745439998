# SPDX-License-Identifier: Apache-2.0
# For tests of bench from outside, which source it: an empty folder to work in, gone at the end, and what is expected of $bench.
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
