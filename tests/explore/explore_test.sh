#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# explore_test.sh BIN SOURCE [SHIM]: tests the explorer in a window on an X server of its own, controlled by input
# events. The explorer flies, renders on every backend, compares, exports pictures equal to bin/render's, records a path
# that flythrough accepts, and survives drivers that die or hang. SHIM: the shim of OpenCL (tests/drivers). Without Xvfb, SDL's
# dummy window is used.
set -uo pipefail
bin=$1
source=$2
shim=${3:-}
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

# Tests flying, turning, undo, both fractals, and looks.
cat >fly.txt <<'END'
rest
tell
key W 30
drag 4 2 20
rest
tell
key Ctrl+Z
key Ctrl+Z
rest
tell
key F7
rest
tell
key F8
rest
tell
shoot fly.png
END
play fly --fractal mandelbulb --size 320x240
is fly 1 't["panes"][0]["samples"]' 4
is fly 2 't["eye"][0] < 1.2 and t["view"] > 30' True
is fly 3 't["eye"][0] > 1.199' True
is fly 4 't["fractal"] != "mandelbulb"' True
is fly 5 't["said"]' 'look: lagoon'
for line in 1 4; do is fly $line 't["colouring"]' 3; done
is fly 5 't["colouring"]' 4
[ -s fly.png ] || fail "fly: no screenshot"

# The exported picture equals the one that bin/render makes from the exported parameter file.
cat >hand.txt <<'END'
rest
key D 20
key Ctrl+S
picture 200 120
key Ctrl+P
tasks
rest
tell
END
play hand --fractal box --size 320x240 --mode exact --precision double
if "$bin/render" picture-001.dat --fractal box --backend openmp --output again.png 2>hand.err; then
    "$bin/imgdiff" picture-001.png again.png >/dev/null || fail "hand: bin/render's picture is another one"
    "$bin/render" picture-001.dat --fractal box --backend openmp --mode fast --output fast.png
    "$bin/imgdiff" picture-001.png fast.png >/dev/null && fail "hand: a picture in another mode is the same"
else
    fail "hand: $(cat hand.err)"
fi
"$bin/render" view-001.dat --fractal box --output view.png 2>/dev/null || fail "hand: the view cannot be drawn"
[ "$(ls -- *.part* .*tmp* 2>/dev/null | wc -l)" = 0 ] || fail "hand: unfinished files are left"

# A path is recorded, smoothed, audited in the background, saved and opened again. flythrough's audit finds that the
# path keeps its promises, and flythrough renders it. A path has 30 frames per second, and the screen about 60.
# Therefore the 180 frames of the screen give a path of about 90 frames.
cat >path.txt <<'END'
rest
key Ctrl+R
key W 120
press Right
key W 40
release Right
key W 20
key Ctrl+R
key Ctrl+L
audited
tell
key Ctrl+D
open path-001.json
key PageDown
rest
tell
key Space
wait 10
tell
END
play path --fractal box --size 320x240
is path 1 't["path"]["frames"] > 60 and t["path"]["rows"]' 4
is path 1 't["path"]["broken"]' 0
is path 2 't["path"]["at"]' 30.0
is path 3 't["path"]["at"] > 30' True
"$bin/flythrough" audit path-001.json >audit 2>audit.err || fail "path: $(cat audit audit.err)"
"$bin/flythrough" render path-001.json --stills stills --every 30 --size 64x36 >/dev/null 2>stills.err &&
    [ "$(ls stills/*.png | wc -l)" -gt 2 ] || fail "path: no stills: $(cat stills.err)"

# V shows the views of the folder scenes one after the other, and then the first one again. Their cameras differ.
rm view-*.dat
views=("$source"/scenes/*.*.dat)
{
    echo 'wait 5'
    for _ in "${views[@]}" again; do printf '%s\n' 'key V' 'wait 5' tell save-view; done
} >views.txt
play views --fractal box --size 300x200
camera() { sed -n 2,5p "$1"; }
for number in $(seq ${#views[@]}); do
    file=${views[number - 1]}
    IFS=. read -r name fractal _ < <(basename "$file")
    is views "$number" 't["said"]' "$name, $fractal"
    is views "$number" 't["fractal"]' "$fractal"
    [ "$(camera "view-00$number.dat")" = "$(camera "$file")" ] || fail "views: $name has another camera than its file"
done
is views $((number + 1)) 't["said"]' "$(basename "${views[0]}" | sed 's/[.]/, /; s/[.].*//')"
[ "$(camera view-001.dat)" != "$(camera view-002.dat)" ] || fail "views: two views have one camera"

# Renders on each backend that has a device, one after the other. Then renders in four panes.
{
    printf 'rest\ntasks\n'
    "$bin/render" --list-devices | grep -v 'unavailable\|FAILED' | while read -r _; do printf 'key F4\nrest\ntell\n'; done
} >backends.txt
play backends --fractal box --size 160x120
drawn=$(grep -c . backends.out)
[ "$drawn" -ge 2 ] || fail "backends: $drawn"
for line in $(seq "$drawn"); do is backends "$line" 't["panes"][0]["failure"]' ''; done
[ "$(grep -o '"setup":"[a-z]*' backends.out | sort -u | wc -l)" -ge 2 ] || fail "backends: always the same one"
printf '%s\n' rest 'key F9' 'key F9' 'key F9' rest tell 'key F5' rest tell 'shoot panes.png' >panes.txt
play panes --fractal box --size 400x300
is panes 1 'len(t["panes"])' 4
is panes 1 't["panes"][1]["differing"] > 0' True
# F5 switches the fourth pane back to float. The fourth pane then differs from the first pane in as many pixels as the
# third pane does.
is panes 2 't["panes"][2]["differing"] == t["panes"][3]["differing"]' True

# An error appears as a line in the window or on stderr.
printf '1 2 3\n1 2\n' >bad.dat
printf 'rest\ntell\n' >bad.txt
play bad bad.dat
is bad 1 't["said"].startswith("bad.dat:2: ")' True
is bad 1 't["panes"][0]["failure"]' ''
printf 'rest\nfly\n' >wrong.txt
"$bin/explore" --script wrong.txt 2>wrong.err
[ $? = 2 ] && grep -q '^wrong.txt:2: ' wrong.err || fail "a wrong script: $(cat wrong.err)"
env -u DISPLAY SDL_VIDEODRIVER=x11 "$bin/explore" >no.out 2>no.err
code=$?
[ $code = 77 ] && [ "$(wc -l <no.err)" = 1 ] || fail "no display: exit code $code: $(cat no.err)"
env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER timeout 20 "$bin/explore" >no.out 2>no.err
code=$?
[ $code = 77 ] && [ "$(wc -l <no.err)" = 1 ] || fail "no display is named: exit code $code: $(cat no.err)"

# If a driver dies or hangs, an error line appears and another backend renders.
if [ -n "$shim" ] && "$bin/render" --list-devices | grep -q '^opencl *0: '; then
    printf '%s\n' rest tell 'key F4' rest tell >abort.txt
    printf '%s\n' 'wait 120' tell 'key F4' rest tell >hang.txt
    for action in abort hang; do
        MANDELMARCH_FAULT="launch $action" MANDELMARCH_DEVICE_TIMEOUT=60 LD_PRELOAD=$shim \
            play $action --backend opencl --size 200x160
    done
    is abort 1 '"ended the device" in t["panes"][0]["failure"]' True
    is hang 1 't["panes"][0]["samples"]' 0
    for action in abort hang; do is $action 2 't["panes"][0]["samples"] == 4 and t["panes"][0]["failure"]' ''; done
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
    [ -n "$eye" ] && [ "$eye" != "$(sed -n 2p "$source/paramsBox.dat")" ] && [ "$eye" != "14 8 10" ] ||
        fail "hands: the eye is at '$eye'"
    grep -q '"look": 4' config/mandelmarch/explore.json || fail "hands: the look was not kept in the settings"
fi
[ $failures = 0 ]
