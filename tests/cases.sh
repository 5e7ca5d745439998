#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cases.sh SCRIPT CASE ARGUMENT...: runs the function test_CASE of SCRIPT, which gets the arguments, in an empty folder.
# CMake adds a test for each case (mandelmarch_cases in Functions.cmake) and lists all cases in the variable CASES; a
# function test_* that is not listed is an error. Paths among the arguments must be absolute.
set -uo pipefail
script=$(realpath "$1")
case=$2
shift 2
top=$(mktemp -d)
trap 'chmod -R u+w "$top"; rm -rf "$top"' EXIT
mkdir "$top/folder"
cd "$top/folder" || exit 1

# fail TEXT: reports a failure, also from a subshell; the case continues.
fail() { echo "FAILED: $*" | tee -a "$top/failures"; }

# expect CODE COMMAND...: runs the command, whose output goes to the files stdout and stderr, and checks its exit code.
# With code 1 it may print one line on stderr. With 2 or 77 it must print one line and must not change files.
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

# says PATTERN, prints PATTERN: check the last command's stderr and stdout.
says() { grep -Eq -- "$1" stderr || fail "stderr does not say '$1': $(head -c 500 stderr)"; }
prints() { grep -Eq -- "$1" stdout || fail "stdout does not have '$1': $(head -c 500 stdout)"; }
silent() { [ ! -s stderr ] || fail "something on stderr: $(head -c 500 stderr)"; }

# same_file A B expects equal bytes, same_picture A B equal pixels and depths, other_picture A B different ones.
same_file() { cmp -s "$1" "$2" || fail "$1 is not $2 ${3:-}"; }
same_picture() { "$bin/imgdiff" "$1" "$2" >difference || fail "$1 and $2 differ: $(tr '\n' ' ' <difference)"; }
other_picture() { "$bin/imgdiff" "$1" "$2" >difference && fail "$1 and $2 are the same picture"; }

# has_device BACKEND: is true if the backend has a device.
has_device() { "$bin/render" --list-devices 2>/dev/null | grep -q "^$1 *0: "; }

. "$script"
functions=$(compgen -A function test_ | sort)
listed=$(printf 'test_%s\n' ${CASES:-$case} | sort)
[ -z "${CASES+set}" ] || [ "$functions" = "$listed" ] ||
    fail "cases of $script and of CMake differ: $(diff <(echo "$functions") <(echo "$listed") | grep '^[<>]')"
if declare -F "test_$case" >/dev/null; then "test_$case"; else fail "$script has no case '$case'"; fi
[ ! -e "$top/failures" ]
