#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# resume_test.sh FLYTHROUGH KILLS: a film that is killed at random moments and resumed equals the undisturbed film, and
# no finished segment is rendered twice. Also tests a full disk, a missing or failing encoder, and array jobs.
kills=$2
. "$(dirname "$0")/films.sh"
# Many kills need a longer film.
frames=330
[ "$kills" -gt 5 ] && frames=2400
segments=$(((frames + 59) / 60))
small="--size 64x36 --samples 1 --backend openmp --title Title --authors Authors"
md5() { ffmpeg -v error -i "$1" -f framemd5 - | grep -v '^#'; }

run 0 plan path.json --frames $frames --seed 2 --map map.json
python3 - $frames <<'PY' || fail "the map is not what it should be"
import json, sys
path, found, frames = json.load(open("path.json")), json.load(open("map.json")), int(sys.argv[1])
assert all(len(found[key]) == frames for key in ("x", "y", "z", "clearance", "turn"))
assert all(abs(found["x"][i] - path["frames"][i]["location"][0]) < 1e-3 for i in range(frames))
assert 0 < min(found["clearance"]) and max(found["turn"]) <= 1.2
assert 0 < len(found["balls"]) <= found["ball_count"] and all(len(ball) == 4 for ball in found["balls"])
PY
run 0 render path.json $small --output whole.mp4 --summary summary.json
says "$segments of $segments segments"
python3 - $frames <<'PY' || fail "the summary is not what it should be"
import json, sys
found, frames = json.load(open("summary.json")), int(sys.argv[1])
assert found["frames"] == found["frames_rendered"] == frames and found["backend"] == "openmp" and found["device"]["name"]
assert abs(found["seconds_per_frame"] * frames - found["seconds"]) < 1e-6
PY
[ "$(md5 whole.mp4 | wc -l)" = $((frames + 120)) ] || fail "whole.mp4 has $(md5 whole.mp4 | wc -l) frames, not 120 + $frames"
[ -e whole.mp4.parts ] && fail "parts are left"
run 0 render path.json $small --output whole.mp4 --summary summary.json
says "0 of $segments segments"
grep -q '"seconds_per_frame": null' summary.json || fail "a film that was there has seconds a frame"

# Kills flythrough at pseudo-random moments. If the film is complete before the kill, it is started again.
hits=0
RANDOM=7
for ((try = 0; hits < kills && try < 10 * kills; ++try)); do
    "$program" render path.json $small --output killed.mp4 2>/dev/null &
    job=$!
    sleep "$((RANDOM % 2)).$((RANDOM % 900 + 100))"
    kill -9 $job 2>/dev/null && hits=$((hits + 1))
    wait $job 2>/dev/null
    if [ -e killed.mp4 ]; then
        cmp whole.mp4 killed.mp4 || fail "a film killed $hits times is another one"
        rm -f killed.mp4* before
        continue
    fi
    ls -l --time-style=full-iso killed.mp4.parts/*/segment-* 2>/dev/null | awk '{print $5, $7, $9}' >now
    # Finished segments must still exist, unchanged.
    [ -e before ] && comm -23 <(sort before) <(sort now) | grep -q . && fail "a finished segment was made again: kill $hits"
    mv now before
done
[ $hits = "$kills" ] || fail "only $hits of $kills kills met a running program"
run 0 render path.json $small --output killed.mp4
same killed.mp4 whole.mp4 "killed $kills times"

# Two array jobs render different segments at the same time; then the film is joined.
"$program" render path.json $small --output array.mp4 --segments 0-2 2>stderr0 &
run 0 render path.json $small --output array.mp4 --segments 3-$((segments - 1))
wait %1 || fail "segments 0-2: $(cat stderr0)"
says 'not joined'
run 0 render path.json $small --output array.mp4
says "0 of $segments segments"
same array.mp4 whole.mp4 "of array jobs"

# The disk, simulated by a limit on file sizes, is full; then there is space again.
(ulimit -f 12; exec "$program" render path.json ${small/64x36/320x180} --output full.mp4 2>stderr)
[ $? = 1 ] || fail "a full disk gives another exit code than 1"
[ "$(wc -l <stderr)" -le 3 ] || fail "a full disk says too much: $(cat stderr)"
says 'the encoder failed|an incomplete file'
ls full.mp4.parts/*/.part-* >/dev/null 2>&1 && fail "a full disk leaves parts"
[ -e full.mp4 ] && fail "a full disk leaves half a film"

# An encoder that exits with 0 after half a file, as ffmpeg does if there is no space for the file's end.
cat >halving <<'END'
#!/bin/sh
ffmpeg "$@" || exit 1
for last; do :; done
case "$last" in .part-0*) truncate -s -100 "$last" ;; esac
END
chmod +x halving
MANDELMARCH_FFMPEG=$PWD/halving "$program" render path.json $small --output half.mp4 2>stderr
[ $? = 1 ] || fail "half a file gives another exit code than 1"
says 'an incomplete file'
run 0 render path.json $small --output half.mp4
same half.mp4 whole.mp4 "after half a file"

# A missing encoder and a failing one are detected before the first frame.
MANDELMARCH_FFMPEG=/nowhere/ffmpeg run 1 render path.json $small --output none.mp4
says '/nowhere/ffmpeg'
MANDELMARCH_FFMPEG=false run 1 render path.json $small --output none.mp4
says 'does not work'
[ -e none.mp4.parts ] && fail "work was begun without an encoder"

# Several MPI ranks, if mpirun exists and the program is linked with MPI.
if command -v mpirun >/dev/null && ldd "$program" | grep -q libmpi; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    for ranks in 1 2 4; do
        timeout 120 mpirun --oversubscribe --bind-to none -n $ranks "$program" render path.json $small --output mpi.mp4 2>stderr ||
            fail "$ranks ranks: $(cat stderr)"
        says "$segments of $segments segments"
        cmp whole.mp4 mpi.mp4 || fail "the film of $ranks ranks is another one"
        rm -f mpi.mp4*
    done
fi
finish
