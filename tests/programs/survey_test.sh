# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with BIN SOURCE: render warns if a picture is empty or wrong, and rejects scenes that cannot
# give a picture.
bin=$1
source=$2
cp "$source"/params*.dat .
# run CODE FRACTAL ARGUMENTS...: runs render and checks its exit code.
run() {
    rm -f p.png s.json
    expect "$1" "$bin/render" --fractal "${@:2}" --size 40x40 --backend openmp --output p.png --stats s.json
}
stats() { grep -Eq -- "$1" s.json || fail "the statistics do not say '$1': $(grep -A8 survey s.json)"; }
# change FILE NUMBER VALUES NUMBER VALUES ...: prints the parameter file FILE, with the NUMBER-th line of values
# replaced by VALUES, for each pair.
change() {
    local file=$1
    shift
    awk -v changes="$(printf '%s\n' "$@")" 'BEGIN { n = split(changes, c, "\n"); for (i = 1; i < n; i += 2) to[c[i]] = c[i + 1] }
        /^#/ { print; next } { ++k; print (k in to) ? to[k] : $0 }' "$file"
}

# Negative controls of the other cases: official scenes give no warning, in any precision and mode.
test_official_scenes() {
    local fractal how
    for fractal in Bulb Box Julia; do
        for how in "--precision double" "--precision float" "--precision float --mode fast"; do
            run 0 "${fractal,}" params$fractal.dat $how
            silent
            stats '"warnings": \[\]'
        done
    done
}

test_nothing_in_view() {
    change paramsBox.dat 1 "14000 8000 10000" >far.dat
    run 0 box far.dat
    says 'nothing was hit'
    stats '"hit": 0\.0,'
    change paramsBulb.dat 2 "5 0.26 0.2" >away.dat
    run 0 bulb away.dat
    says 'nothing was hit'
    run 0 box paramsBox.dat --eyes 1e5
    says 'nothing was hit'
    # If only a small part of the fractal is in view, there is no warning.
    change paramsBulb.dat 1 "3 .65 .5" 4 2.7 >near.dat
    run 0 bulb near.dat
    grep -q 'nothing' stderr && fail "a picture: $(cat stderr)"
}

# If the camera is inside the solid, all rays end at once. If the picture then has only one colour, this is an error,
# otherwise a warning.
test_inside_the_solid() {
    change paramsBulb.dat 1 ".1 .1 .1" 2 "1 2 3" >inside.dat
    run 2 bulb inside.dat
    says '^inside.dat: the camera is inside the solid'
    change paramsBox.dat 1 ".1 .1 .1" 2 "1 2 3" >inside.dat
    run 0 box inside.dat
    says 'the camera is inside the solid'
    stats '"in_solid": true'
}

# The detail level is too fine for float and for double.
test_out_of_steps() {
    change paramsBox.dat 6 "-20" >fine.dat
    run 0 box fine.dat
    says '[0-9]+ % of the rays ran out of their 8000 steps'
    stats '"out_of_steps": 0\.[0-9]*[1-9]'
}

# The camera is 1e-7 in front of the surface of the Mandelbulb of power 8, too near for float. Its place was found by
# bisection on a ray from the centre, between points whose orbits escape within 100 iterations and points whose orbits
# do not.
test_too_near_for_float() {
    local mode
    change paramsBulb.dat 1 "0.78769342577692103 0.15967336230918755 0.13110231634875802" 2 "0 0 0" 4 1 6 -8 >deep.dat
    for mode in exact fast; do
        run 0 bulb deep.dat --precision float --mode $mode
        says "float's digits are too few for this view: [0-9]+ % of the picture is off, expected --precision double"
        grep -q 'shorter steps' stderr && fail "two words for one thing: $(cat stderr)"
        stats '"lost_in_float": (1\.0|0\.[1-9])'
        run 0 bulb deep.dat --precision double --mode $mode
        grep -q float stderr && fail "double: $(cat stderr)"
    done
}

# A panorama shows all directions, 360 by 180 degrees.
test_panoramas() {
    expect 2 "$bin/render" --fractal bulb --projection equirectangular --output p.png --size 100x100
    says 'equirectangular: 100 x 100 pixels given, expected 2 times as wide as high'
}
