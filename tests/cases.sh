#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cases.sh SCRIPT CASE ARGUMENT...: sources SCRIPT with the arguments, in an empty folder, and runs its function
# test_CASE. CMake adds a test for each case (mandelmarch_cases in Functions.cmake) and lists all cases in the variable
# CASES. If SCRIPT has a function test_* that is not listed, the case fails. Paths among the arguments must be absolute.
set -uo pipefail
script=$(realpath "$1")
case=$2
shift 2
top=$(mktemp -d)
trap 'chmod -R u+w "$top"; rm -rf "$top"' EXIT
mkdir "$top/folder"
cd "$top/folder" || exit 1

# fail TEXT: reports a failure, even if it is called in a subshell. The case continues and fails at its end.
fail() { echo "FAILED: $*" | tee -a "$top/failures"; }

# expect CODE COMMAND...: runs the command, whose output goes to the files stdout and stderr, and expects this exit
# code. If CODE is 1, the command may print at most one line on stderr. If CODE is 2 or 77, the command must print one
# line there and must not change files.
expect() {
    local wanted=$1 before lines got
    shift
    before=$(listed_files)
    "$@" >stdout 2>stderr </dev/null
    got=$?
    [ $got = "$wanted" ] || fail "exit code $got, expected $wanted: $*: $(head -c 500 stderr)"
    lines=$(wc -l <stderr)
    case $wanted in
        1) [ "$lines" -le 1 ] || fail "$lines lines on stderr: $*: $(head -c 500 stderr)" ;;
        2 | 77)
            [ "$lines" = 1 ] || fail "$lines lines on stderr: $*: $(head -c 500 stderr)"
            [ "$before" = "$(listed_files)" ] || fail "files changed: $*"
            ;;
    esac
    [ -z "$(find . -name '.mandelmarch-*')" ] || fail "an unfinished file is left: $*"
}
listed_files() { find . -type f ! -name stderr ! -name stdout -printf '%p %s %T@\n' | sort; }

# says PATTERN: expects that the last command's stderr matches PATTERN. prints PATTERN: expects that its stdout matches.
# silent: expects that its stderr is empty.
says() { grep -Eq -- "$1" stderr || fail "stderr does not say '$1': $(head -c 500 stderr)"; }
prints() { grep -Eq -- "$1" stdout || fail "stdout does not have '$1': $(head -c 500 stdout)"; }
silent() { [ ! -s stderr ] || fail "something on stderr: $(head -c 500 stderr)"; }

# same_file A B: expects equal bytes. same_picture A B: expects equal pixels and depths. other_picture A B: expects
# different pixels or depths.
same_file() { cmp -s "$1" "$2" || fail "$1 is not $2 ${3:-}"; }
same_picture() { "$bin/imgdiff" "$1" "$2" >difference || fail "$1 and $2 differ: $(tr '\n' ' ' <difference)"; }
other_picture() { "$bin/imgdiff" "$1" "$2" >difference && fail "$1 and $2 are the same picture"; }

# has_device BACKEND: succeeds if the backend has a device.
has_device() { "$bin/render" --list-devices 2>/dev/null | grep -q "^$1 *0: "; }

. "$script"
functions=$(compgen -A function test_ | sort)
listed=$(printf 'test_%s\n' ${CASES:-$case} | sort)
[ -z "${CASES+set}" ] || [ "$functions" = "$listed" ] ||
    fail "cases of $script and of CMake differ: $(diff <(echo "$functions") <(echo "$listed") | grep '^[<>]')"
if declare -F "test_$case" >/dev/null; then "test_$case"; else fail "$script has no case '$case'"; fi
[ ! -e "$top/failures" ]
