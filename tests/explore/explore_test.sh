#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# explore_test.sh BIN [SHIM]: tests the explorer in a window on an X server of its own; parts_test.cpp tests its model.
# The explorer flies, compares, records a path that flythrough accepts, and survives a driver that dies. SHIM: the
# stand-in for OpenCL of tests/drivers. Without Xvfb, SDL's dummy window is used.
set -uo pipefail
bin=$1
shim=${2:-}
folder=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill "$server"; rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export XDG_CONFIG_HOME=$folder/config XDG_CACHE_HOME=${XDG_CACHE_HOME:-$HOME/.cache}
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

if command -v Xvfb >/dev/null; then
    mkfifo number
    Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>number 2>/dev/null &
    server=$!
    DISPLAY=:$(head -n 1 number)
    export DISPLAY
else
    export SDL_VIDEODRIVER=dummy
fi

# play NAME OPTION...: runs the script NAME.txt with its output in NAME.out and expects exit code 0.
play() {
    local name=$1 code=0
    shift
    timeout 300 "$bin/explore" --script "$name.txt" --folder "$folder" "$@" >"$name.out" 2>"$name.err" || code=$?
    [ $code = 0 ] || fail "$name: exit code $code: $(head -c 500 "$name.err")"
}

# of NAME LINE EXPRESSION: prints the value of a Python expression, in which t is the output of the LINE-th command
# `tell` of the script NAME.
of() {
    sed -n "$2p" "$1.out" | python3 -c 'import json, sys
t = json.load(sys.stdin)
print(eval(sys.argv[1]))' "$3"
}
is() {  # is NAME LINE EXPRESSION VALUE: expects that the expression, as in `of`, has this value
    local found
    found=$(of "$1" "$2" "$3" 2>&1 | tail -n 1)
    [ "$found" = "$4" ] || fail "$1: $3 is '$found', expected '$4'"
}

# Flies, records and smooths a path, and compares panes.
cat >fly.txt <<'END'
rest
tell
hold W 30
rest
tell
undo
rest
tell
next-colouring
save-view
record
hold W 120
record
smooth
rest
tell
save-path
play-or-stop
rest
tell
more-panes
more-panes
more-panes
rest
tell
END
play fly --fractal box --size 320x240 --mode exact --precision double
is fly 1 't["panes"][0]["samples"]' 4
is fly 2 't["eye"][0] < 13.9' True
is fly 3 't["eye"][0]' 14.0
is fly 4 't["path"]["frames"] > 30' True
is fly 5 't["path"]["at"] == t["path"]["frames"] - 1' True
is fly 6 'len(t["panes"])' 4
is fly 6 't["panes"][1]["differing"] > 0' True
[ "$(ls -- *.part* .*tmp* 2>/dev/null | wc -l)" = 0 ] || fail "fly: unfinished files are left"
"$bin/render" view-001.dat --fractal box --output view.png 2>/dev/null || fail "the view cannot be drawn"
"$bin/flythrough" audit path-001.json >audit 2>audit.err || fail "path: $(cat audit audit.err)"

printf 'rest\nfly\n' >wrong.txt
"$bin/explore" --script wrong.txt 2>wrong.err
[ $? = 2 ] && grep -q '^wrong.txt:2: ' wrong.err || fail "a wrong script: $(cat wrong.err)"
env -u DISPLAY SDL_VIDEODRIVER=x11 "$bin/explore" >no.out 2>no.err
code=$?
[ $code = 77 ] && [ "$(wc -l <no.err)" = 1 ] || fail "no display: exit code $code: $(cat no.err)"
env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER timeout 20 "$bin/explore" >no.out 2>no.err
code=$?
[ $code = 77 ] && [ "$(wc -l <no.err)" = 1 ] || fail "no display is named: exit code $code: $(cat no.err)"

# If a driver dies, an error line appears and another backend renders.
if [ -n "$shim" ] && "$bin/render" --list-devices | grep -q '^opencl *0: '; then
    printf '%s\n' rest tell next-backend rest tell >abort.txt
    MANDELMARCH_FAULT="launch abort" LD_PRELOAD=$shim play abort --backend opencl --size 200x160
    is abort 1 '"ended the device" in t["panes"][0]["failure"]' True
    is abort 2 't["panes"][0]["samples"] == 4 and t["panes"][0]["failure"]' ''
fi

# Tests real key events, sent by xdotool through the X server.
if [ -n "$server" ] && command -v xdotool >/dev/null; then
    mkdir hands
    timeout 100 "$bin/explore" --fractal box --folder hands --size 400x300 >hands.out 2>&1 &
    program=$!
    window=$(timeout 60 xdotool search --sync --name 'mandelmarch explore' | tail -n 1)
    xdotool windowfocus --sync "$window" keydown w
    sleep 1
    xdotool keyup w mousemove --window "$window" 300 150 mousedown 1 mousemove_relative 40 10 mouseup 1 key ctrl+s
    for _ in $(seq 100); do [ -s hands/view-001.dat ] && break || sleep 0.1; done
    xdotool key F8 ctrl+q
    wait $program || fail "hands: exit code $?: $(cat hands.out)"
    eye=$(sed -n 2p hands/view-001.dat 2>/dev/null)
    [ -n "$eye" ] && [ "$eye" != "14 8 10" ] || fail "hands: the eye is at '$eye'"
    grep -q '"look": 4' config/mandelmarch/explore.json || fail "hands: the look was not kept in the settings"
fi
[ $failures = 0 ]
