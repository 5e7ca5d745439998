# SPDX-License-Identifier: Apache-2.0
# Cases of the programs, run by tests/cases.sh with BIN SOURCE: exit codes, messages and files.
bin=$1
source=$2
cp "$source"/params*.dat .
small="--size 40x30 --backend openmp"
# bulb OPTION...: renders the official Mandelbulb; usually called by `expect`.
bulb() { "$bin/mandelbulb" paramsBulb.dat $small "$@"; }

test_pictures() {
    expect 0 "$bin/mandelbulb" paramsBulb.dat $small
    [ -f imageBulb.bmp ] || fail "the file named in the parameter file is missing"
    expect 0 "$bin/mandelbox" paramsBox.dat $small
    expect 0 "$bin/render" --fractal mandelbox paramsBox.dat $small --output again.bmp
    same_file image.bmp again.bmp
    expect 0 "$bin/mandelbox" paramsBox.dat --size 40x30 --output again.png
    says '^drawing with openmp \('
    same_picture image.bmp again.png
    expect 0 bulb --output /dev/null --stats /dev/null
    expect 0 bulb --look "$source/scenes/coral.look" --output coral.png
    expect 0 bulb --look "$source/scenes/dusk.look" --output dusk.png
    expect 1 "$bin/imgdiff" coral.png dusk.png
    expect 0 "$bin/mandelbulb" --help
    prints 'plus, for each pixel, 3 bytes'
    expect 0 "$bin/mandelbulb" --list-devices
    prints '^openmp *0: '
}

test_standard_streams() {
    expect 0 bulb --output a.png
    expect 0 bulb --output a.bmp
    expect 0 bulb --output /dev/stdout
    same_file stdout a.bmp
    silent
    "$bin/mandelbulb" - $small --output - <paramsBulb.dat >piped.bmp || fail "from - to -"
    same_file piped.bmp a.bmp
    "$bin/imgdiff" - a.png <a.bmp >stdout || fail "imgdiff of standard input"
    sed 's/^imageBulb.bmp/-/' paramsBulb.dat >dash.dat
    expect 0 "$bin/mandelbulb" dash.dat $small --stats dash.json
    same_file stdout a.bmp
    [ -e ./- ] && fail "a file called - is made"
    # A program ignores that it cannot write a message. If it cannot write a result, it fails.
    awk '/^imageBulb/ { print 4 } { print }' paramsBulb.dat >warning.dat
    expect 0 "$bin/mandelbulb" warning.dat $small --output kept.bmp
    says 'warning: '
    expect 0 "$bin/mandelbulb" paramsBulb.dat --size 33x21 --backend openmp --output odd.bmp
    local where command
    for where in '2>/dev/full' '2>&-' '2>&1 | true; exit ${PIPESTATUS[0]}'; do
        rm -f noted.bmp
        expect 0 bash -c "'$bin/mandelbulb' warning.dat $small --output noted.bmp $where"
        same_file noted.bmp kept.bmp "with $where"
        expect 1 bash -c "'$bin/imgdiff' a.bmp odd.bmp $where"
    done
    for command in "imgdiff a.bmp a.bmp" "imgdiff a.bmp a.bmp --json" "imgdiff --help" "mandelbulb --help" \
        "mandelbulb --list-devices"; do
        for where in '>/dev/full' '>&-'; do
            expect 1 bash -c "'$bin'/$command $where"
            says 'standard output cannot be written'
        done
    done
    expect 2 bash -c "'$bin/mandelbulb' paramsBulb.dat $small --output /dev/stdout >&-"
}

# With several samples per pixel, the background keeps its colour, and pixels at edges get mixed colours.
test_samples() {
    expect 0 bulb --output a.png
    expect 0 bulb --samples 3 --output fine.png
    other_picture fine.png a.png
    expect 0 bulb --samples 1 --output fine.png
    same_picture fine.png a.png
    local samples number
    for samples in 0 9 x; do expect 2 bulb --samples $samples; done
    expect 2 "$bin/mandelbulb" paramsBulb.dat --size 40000x10 --samples 2
    says 'expected sides of up to'
    expect 0 bulb --samples 2 --output fine.png
    # In old parameter files, an additional line also selects super-sampling.
    for number in 0 1; do
        awk -v n=$number '/^imageBulb/ { print n } { print }' paramsBulb.dat >super.dat
        expect 0 "$bin/mandelbulb" super.dat $small --output super.png
        says ":27: warning: '$number' taken as the super-sampling"
        if [ $number = 0 ]; then same_file super.png a.png; else same_file super.png fine.png; fi
    done
}

# unit/region_test.cpp tests the bits of regions. The whole picture, of which a region is rendered, may be larger than
# any picture that can be rendered at once.
test_regions() {
    expect 0 bulb --output a.exr
    expect 0 bulb --region 0,0,40,30 --output region.exr
    same_picture region.exr a.exr
    expect 0 bulb --region 5,10,20x10 --output region.ppm
    [ "$(sed -n 2p region.ppm)" = "20 10" ] || fail "a region of another size"
    expect 0 "$bin/mandelbulb" paramsBulb.dat --size 100000x40 --region 50000,20,30,2 --mode fast --precision float \
        --backend openmp --output region.png
    for region in 0,0,41,30 -1,0,2,2 0,0,0,1 0,0,1x; do expect 2 bulb --region $region; done
    says 'expected X,Y,WIDTH,HEIGHT of a part of 40 x 30 pixels'
    expect 2 bulb --region 0,0,4,4 --eyes 1
}

# If pictures differ, imgdiff prints a `render --trace` command. This command prints the steps of one ray and writes no
# picture.
test_differences_and_traces() {
    expect 0 bulb --output a.bmp
    expect 0 "$bin/mandelbox" paramsBox.dat $small --output box.bmp
    expect 1 "$bin/imgdiff" a.bmp box.bmp --json --map map.png
    prints '"same": false'
    prints '"trace": "bin/render .* --size 40x30 --pixel '
    [ -s map.png ] || fail "imgdiff --map"
    expect 2 "$bin/imgdiff" a.bmp missing.bmp
    expect 2 "$bin/imgdiff" a.bmp paramsBox.dat
    expect 2 "$bin/imgdiff" a.bmp
    expect 2 "$bin/imgdiff" a.bmp a.bmp --map map.exr
    expect 1 "$bin/imgdiff" a.bmp box.bmp
    local traced options
    traced=$(sed -n 's/^why: bin\/render --fractal FRACTAL PARAMS.dat \(--size 40x30 --pixel [0-9]*,[0-9]* --trace\),.*/\1/p' stdout)
    [ -n "$traced" ] || fail "imgdiff prints no command: $(cat stdout)"
    expect 0 "$bin/render" --fractal mandelbulb paramsBulb.dat $traced
    prints '^colour .*, as bytes [0-9]* [0-9]* [0-9]*$'
    for options in "" "--precision float" "--mode fast --backend openmp"; do
        expect 0 "$bin/mandelbox" paramsBox.dat --size 40x30 $options --pixel 20,15 --trace
        prints 'hit: DE is below the tolerance$'
    done
    prints '^a trial on openmp chose the step factor$'
    for options in "--trace" "--pixel 40,3 --trace" "--pixel 3,x --trace"; do
        expect 2 "$bin/mandelbulb" paramsBulb.dat --size 40x30 $options
    done
    says "^--pixel: '3,x' given, expected X,Y of a pixel, from 0,0 at the bottom left to 39,29 at the top right"
}

test_statistics() {
    expect 0 bulb --precision float --mode fast --threads 3 --simd-width 1 --stats stats.json --output a.png
    local text
    for text in '"backend": "openmp"' '"precision": "float"' '"mode": "fast"' '"threads": 3' '"simd_width": 1' \
        '"de_calls": [1-9]' '"iterations": [1-9]' '"steps": [1-9]' '"wall": 0'; do
        grep -q "$text" stats.json || fail "statistics without $text"
    done
    # The scene is too fine for float, and the stats have this.
    sed 's/^14.0 8.0 10.0$/-2.0239316 -0.1431710 2.4512503/; s/^0 0 0$/-0.2198636 0.2761599 0.0554219/; s/^-4$/-3.7215097/
         s/^2 0.5 1$/2.1486392 0.7831253 1.4890415/; s/^18 100$/32 100/' paramsBox.dat >fine.dat
    expect 0 "$bin/mandelbox" fine.dat --size 61x45 --precision float --mode fast --stats stats.json --output a.png
    grep -q '"unsettled": 0\.[0-9]*[1-9]' stats.json || fail "statistics without what is unsettled"
    expect 0 "$bin/mandelbox" paramsBox.dat --size 61x45 --precision float --mode fast --stats stats.json --output a.png
    grep -q '"step_factor": 0\.95' stats.json || fail "statistics without the steps"
    grep -q '"unsettled": 0\.0,' stats.json || fail "the official scene is unsettled in the statistics"
}

# --version prints one line, with the version that CITATION.cff has. Sanitizer builds have no bench.
test_versions() {
    local version program
    version=$(sed -n 's/^version: //p' "$source/CITATION.cff")
    for program in render mandelbulb mandelbox imgdiff demo bench flythrough; do
        [ -x "$bin/$program" ] || continue
        expect 0 "$bin/$program" --version
        [ "$(wc -l <stdout)" = 1 ] || fail "$program --version prints $(wc -l <stdout) lines"
        prints "^$program $version \(([0-9a-f]{40}|unknown)(, changed)?\)$"
    done
}

test_arguments() {
    local backend arguments
    for backend in openacc opencl vulkan; do
        "$bin/mandelbulb" --list-devices | grep -q "^$backend *unavailable: not built" || continue
        expect 77 "$bin/mandelbulb" paramsBulb.dat --backend $backend --output new.bmp
        says 'not built'
    done
    expect 77 bulb --device 5 --output new.bmp
    expect 77 "$bin/mandelbulb" paramsBulb.dat --size 40x30 --backend reference --precision float --output new.bmp
    for arguments in "" "--nonsense" "paramsBulb.dat --backend metal" "paramsBulb.dat --size 0x5" "paramsBulb.dat --size 5.5x5" \
        "paramsBulb.dat --size 65536x1" "paramsBulb.dat --threads many" "paramsBulb.dat --simd-width 3 --backend openmp" \
        "paramsBulb.dat --device -1" "paramsBulb.dat --without cones" "paramsBulb.dat more.dat"; do
        expect 2 "$bin/mandelbulb" $arguments
    done
    expect 2 "$bin/render" paramsBulb.dat
    # Without a parameter file, render draws the official scene.
    expect 0 "$bin/render" --fractal box --size 40x30 --output official.png
    expect 0 "$bin/render" --fractal box paramsBox.dat --size 40x30 --output given.png
    same_file official.png given.png "without a parameter file"
    # An empty word, as that of a shell variable without a value, is not an option that was not given.
    for arguments in "render --fractal bulb" "render --fractal box --output" "render --fractal box --size" "imgdiff a.bmp" \
        "demo --folder" "flythrough plan --power" "flythrough plan" "bench --filter"; do
        [ -x "$bin/${arguments%% *}" ] || continue
        expect 2 "$bin/"$arguments ""
        says ": '' given, expected a value"
    done
    expect 2 bulb --output=
    says "'--output=' given, expected a value behind ="
}

# A message about a parameter file begins with the file's name and the line, and explains units, comments and
# super-sampling. unit/parameter_file_test.cpp tests other faults.
test_parameter_files() {
    expect 2 "$bin/mandelbulb" missing.dat
    says '^missing.dat: No such file .*expected'
    awk '!/^#/ && NF == 1 && !done { print 60; done = 1; next } { print }' paramsBulb.dat >degrees.dat
    expect 2 "$bin/mandelbulb" degrees.dat
    says "field of view, in units of 65 degrees, is '60', expected"
    "$bin/mandelbulb" --help | grep -q '65 degrees' || fail "--help has no unit of the field of view"
    sed 's/^imageBulb.bmp/frame #3.bmp/' paramsBulb.dat >comment.dat
    expect 2 "$bin/mandelbulb" comment.dat $small
    says 'frame: .* # behind a blank'
}

# An output file that cannot be written is reported before anything is rendered.
test_output_files() {
    local name
    for name in image image.tiff; do
        sed "s/^imageBulb.bmp/$name/" paramsBulb.dat >unknown.dat
        expect 2 "$bin/mandelbulb" unknown.dat $small
    done
    expect 2 bulb --output missing/a.bmp
    expect 2 bulb --stats missing/a.json --output new.bmp
    expect 2 "$bin/mandelbulb" paramsBulb.dat --size 65535x65535 --output huge.exr
    says 'MiB of memory'
    mkdir gone
    (cd gone && rmdir ../gone && "$bin/mandelbulb" ../paramsBulb.dat $small --output a.bmp 2>"$top/folder/stderr")
    [ $? = 1 ] && [ "$(wc -l <stderr)" = 1 ] || fail "a deleted folder: $(head -c 300 stderr)"
    # A program refuses to use one file for two purposes. unit/files_test.cpp tests different names of one file.
    expect 0 bulb --output a.bmp
    cp a.bmp twice.bmp
    ln -s twice.bmp link.bmp
    expect 2 bulb --output link.bmp --stats twice.bmp
    says 'the same file'
    cp paramsBulb.dat parameters.bmp
    expect 2 "$bin/mandelbulb" parameters.bmp $small --output ./parameters.bmp
    expect 2 "$bin/imgdiff" a.bmp link.bmp --map twice.bmp
    same_file twice.bmp a.bmp
    same_file parameters.bmp paramsBulb.dat
}

# Names with control characters, and long values, are printed in one short line.
test_odd_names() {
    local odd=$'a\n\e[31m'
    awk '/^imageBulb/ { print 4 } { print }' paramsBulb.dat >"$odd.dat"
    expect 0 "$bin/mandelbulb" "$odd.dat" $small --output "$odd.png"
    [ "$(wc -l <stderr)" = 1 ] || fail "a warning of $(wc -l <stderr) lines"
    truncate -s 300 "$odd.png"
    expect 2 "$bin/imgdiff" "$odd.png" paramsBulb.dat
    says '^a\\n\\x1b\[31m'
    expect 2 "$bin/mandelbulb" paramsBulb.dat --size "$(head -c 100000 /dev/zero | tr '\0' 7)"
    [ "$(wc -c <stderr)" -lt 3000 ] || fail "a line of $(wc -c <stderr) bytes"
}

# If a signal arrives while a picture is rendered, it ends the program, and no file remains. unit/files_test.cpp tests
# other signals.
test_signals() {
    sed '0,/^[^#]/s/^[^#].*/90 90 90/' paramsBulb.dat >far.dat
    "$bin/mandelbulb" far.dat --size 3000x3000 --backend openmp --output signal.png 2>stderr &
    until compgen -G '.mandelmarch-*' >stdout || ! kill -0 $!; do :; done
    kill -STOP $!
    compgen -G '.mandelmarch-*' >stdout || fail "no picture was in the making: $(cat stderr)"
    kill -TERM $!
    kill -CONT $!
    wait $! 2>stderr
    [ $? = 143 ] || fail "another exit code than 143 after SIGTERM"
    [ -z "$(find . -name '.mandelmarch-*' -o -name signal.png)" ] || fail "SIGTERM leaves $(ls -A)"
}

# The disk is full, which /dev/full simulates. unit/image_file_test.cpp tests all formats.
test_full_disk() {
    expect 1 bulb --output /dev/full
    says 'No space left'
    # A picture is never there without the statistics of its run.
    expect 1 bulb --output /dev/full --stats first.json
    [ -s first.json ] || fail "the statistics come after the picture"
    expect 1 bulb --output last.bmp --stats /dev/full
    [ -s last.bmp ] || fail "a picture is lost, because its statistics cannot be written"
}

test_environment() {
    local name
    MANDELMARCH_ISOLATION=maybe expect 2 "$bin/render" --list-devices
    says "^MANDELMARCH_ISOLATION: 'maybe' given, expected on or off"
    MANDELMARCH_BACKENDS=openmp,nonsense expect 2 "$bin/render" --list-devices
    says "^MANDELMARCH_BACKENDS: 'nonsense' given, expected some of reference, openmp"
    MANDELMARCH_DRIVER_LOG=./s.bmp expect 2 "$bin/mandelbulb" paramsBulb.dat $small --output s.bmp
    says 'the same file'
    for name in OMP_STACKSIZE GOMP_STACKSIZE; do
        expect 2 env $name=16k "$bin/mandelbulb" paramsBulb.dat $small --output s.bmp
        says "^$name: '16k' given, expected at least 64K"
    done
}
