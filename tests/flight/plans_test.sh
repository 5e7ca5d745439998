# SPDX-License-Identifier: Apache-2.0
# Cases of flythrough with planned flights, run by tests/cases.sh with BIN SOURCE [KILLS].
. "$(dirname "$script")/films.sh"
kills=${3:-3}

# If flythrough is killed at random moments and started again, the film equals the undisturbed film. No finished segment
# is rendered twice.
test_killed() {
    local frames=330 hits=0 try job options="--size 64x36 --samples 1 --backend openmp --title Title --authors Authors"
    # A longer film leaves time for many kills.
    [ "$kills" -gt 5 ] && frames=2400
    run 0 plan path.json --frames $frames --seed 2
    run 0 render path.json $options --output whole.mp4
    says "$(((frames + 59) / 60)) of $(((frames + 59) / 60)) segments"
    [ "$(ffmpeg -v error -i whole.mp4 -f framemd5 - | grep -vc '^#')" = $((frames + 120)) ] || fail "frames or title are missing"
    # Kills flythrough at pseudo-random moments. If the film is complete before a kill, the film is started again.
    RANDOM=7
    for ((try = 0; hits < kills && try < 10 * kills; ++try)); do
        "$program" render path.json $options --output killed.mp4 2>/dev/null &
        job=$!
        sleep "$((RANDOM % 2)).$((RANDOM % 900 + 100))"
        kill -9 $job 2>/dev/null && hits=$((hits + 1))
        wait $job 2>/dev/null
        if [ -e killed.mp4 ]; then
            same_file killed.mp4 whole.mp4 "killed $hits times"
            rm -f killed.mp4* before
            continue
        fi
        ls -l --time-style=full-iso killed.mp4.parts/*/segment-* 2>/dev/null | awk '{print $5, $7, $9}' >now
        # Segments that were finished before this kill must still exist, unchanged.
        [ -e before ] && comm -23 <(sort before) <(sort now) | grep -q . && fail "a finished segment was made again: kill $hits"
        mv now before
    done
    [ $hits = "$kills" ] || fail "only $hits of $kills kills met a running program"
    run 0 render path.json $options --output killed.mp4
    same_file killed.mp4 whole.mp4 "killed $kills times"
}

test_map_and_summary() {
    run 0 plan path.json --frames 120 --seed 2 --map map.json
    run 0 render path.json $small --output film.mp4 --summary summary.json
    python3 - <<'PY' || fail "the map or the summary is not what it should be"
import json
path, found, film = (json.load(open(f"{name}.json")) for name in ("path", "map", "summary"))
assert all(len(found[key]) == 120 for key in ("x", "y", "z", "clearance", "turn"))
assert all(abs(found["x"][i] - path["frames"][i]["location"][0]) < 1e-3 for i in range(120))
assert 0 < min(found["clearance"]) and max(found["turn"]) <= 1.2
assert 0 < len(found["balls"]) <= found["ball_count"] and all(len(ball) == 4 for ball in found["balls"])
assert film["frames"] == film["frames_rendered"] == 120 and film["backend"] == "openmp" and film["device"]["name"]
assert abs(film["seconds_per_frame"] * 120 - film["seconds"]) < 1e-6
PY
}

# A flight visits the places of a file. visiting_test.cpp tests how exactly it does.
test_places() {
    echo "location_x,location_y,location_z,look_at_x,look_at_y,look_at_z,second,stay" >places.csv
    cp places.csv solid.csv
    echo "4.59089102,3.307132358,5.499079091,5.1289,2.5250,5.1848,0,1" >>places.csv
    echo "0.3,0.2,0.1,1,1,1" >>solid.csv
    # A flight of one second, which begins and ends at the place.
    run 0 plan new.json --fractal box --places places.csv --fps 60
    python3 - <<'PY' || fail "a flight of one place is not there for one second"
import json, math
frames = json.load(open("new.json"))["frames"]
assert 60 <= len(frames) <= 63, len(frames)
assert all(math.dist(frame["location"], (4.59089102, 3.307132358, 5.499079091)) < 0.3 for frame in frames)
PY
    "$program" plan solid.json --fractal box --places solid.csv >stdout 2>stderr
    [ $? = 2 ] || fail "a place in the solid: $(tail -1 stderr)"
    says 'solid.csv:2: the camera cannot reach the location 0.3,0.2,0.1, inside the fractal; the nearest .* is [0-9.,-]+$'
    run 2 plan other.json --places places.csv --power 8:7 --backend openmp
    says 'places.csv: the shape changes in flight'
    run 2 render path.json --places places.csv
    run 2 plan places.csv --places places.csv
}

# A flight can be planned at another frame rate. path_test.cpp tests that it is the same flight.
test_rates() {
    run 2 plan new.json --fps 29.97
    run 0 plan plan.json --frames 48 --fps 24
    python3 -c 'import json; path = json.load(open("plan.json"))
assert path["frames_per_second"] == 24 and len(path["frames"]) == 48' || fail "another rate"
    run 0 render plan.json $small --fps 12 --stills half
    [ "$(ls half/*.png | wc -l)" = 24 ] || fail "a path at half its rate has $(ls half)"
}

# A shape that cannot be flown through is refused before planning, from whatever input it comes. changing_test.cpp has
# more such shapes.
test_refused_shapes() {
    sed "s/^2 0.5 1$/0.5 0.5 1/" "$source/paramsBox.dat" >box.dat
    sed "s/^0 4.0 8.0$/0 4.0 1.2/" "$source/paramsBulb.dat" >bulb.dat
    run 2 plan --frames 120 --fractal box --params box.dat --output new.json
    says "box.dat: a mandelbox with scale 0.5 cannot be flown through, expected another scale"
    run 2 film --frames 120 --fractal box --scale 2:0.9 --output new.mp4
    says "^--scale: .*cannot be flown through"
    run 2 plan --frames 120 --params bulb.dat --output new.json
    says "a mandelbulb with power 1.2 cannot be flown through, expected another power, 8, say"
    # A number on the command line replaces that of the parameter file.
    run 0 plan --frames 120 --params bulb.dat --power 8
}

# If no flight is found, the message names the cause and the remedy, in the same words for every seed.
test_no_flight() {
    for seed in 1 2; do
        timeout 100 "$program" plan --fractal julia --params "$source/paramsJulia.dat" --frames 120 --seed $seed \
            --output new.json >stdout 2>stderr
        [ $? = 2 ] || fail "a Julia set: $(tail -1 stderr)"
        says 'this julia has no .*; another seed does not help, expected another shape'
    done
}
