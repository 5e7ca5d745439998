# SPDX-License-Identifier: Apache-2.0
# Sourced by tests that run bench. Enters an empty folder, which is deleted on exit, and defines functions that run the
# program $bench and check its behaviour.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; exit 1; }
# expect CODE ARGUMENT...: runs $bench and checks its exit code.
expect() {
    local code=$1 got=0
    shift
    "$bench" "$@" >out 2>err || got=$?
    [ "$got" = "$code" ] || { cat out err >&2; fail "bench $* exited with $got, expected $code"; }
}
# refused PATTERN ARGUMENT...: runs $bench and checks that it exits with 2 and that its stderr is one line, which
# matches PATTERN.
refused() {
    expect 2 "${@:2}"
    [ "$(wc -l <err)" = 1 ] && grep -q -- "$1" err || fail "bench ${*:2}: '$1' expected in: $(cat err)"
}
