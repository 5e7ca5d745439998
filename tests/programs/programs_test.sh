#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# programs_test.sh BIN SOURCE: runs the programs and checks exit codes, messages and output files.
set -uo pipefail
bin=$1
source=$2
folder=$(mktemp -d)
trap 'chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
cd "$folder"
cp "$source"/params*.dat .
failures=0

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

# expect CODE COMMAND...: checks the exit code and, for 2 and 77, exactly one line on stderr and no new file.
expect() {
    local code=$1 before after got
    shift
    before=$(find . -type f ! -name stderr ! -name stdout | sort)
    "$@" >stdout 2>stderr </dev/null
    got=$?
    [ $got = "$code" ] || fail "exit code $got, expected $code: $* : $(head -c 300 stderr)"
    after=$(find . -type f ! -name stderr ! -name stdout | sort)
    if [ "$code" = 2 ] || [ "$code" = 77 ]; then
        [ "$(wc -l <stderr)" = 1 ] || fail "$(wc -l <stderr) lines on stderr: $* : $(head -c 300 stderr)"
        [ "$before" = "$after" ] || fail "files changed: $*"
    fi
    [ -z "$(find . -name '.mandelmarch-*')" ] || fail "a half file is left: $*"
}

# says PATTERN: checks the last command's stderr.
says() { grep -Eq "$1" stderr || fail "stderr does not say '$1': $(head -c 300 stderr)"; }

small="--size 40x30 --backend openmp"

# Pictures, and the defaults of options.
expect 0 "$bin/mandelbulb" paramsBulb.dat $small
[ -f imageBulb.bmp ] || fail "the file named in the parameter file is missing"
expect 0 "$bin/mandelbox" paramsBox.dat $small
[ -f image.bmp ] || fail "the file named in the parameter file is missing"
expect 0 "$bin/render" --fractal mandelbox paramsBox.dat $small --output again.bmp
expect 0 cmp image.bmp again.bmp
expect 0 "$bin/mandelbox" paramsBox.dat --size 40x30 --output again.png
says '^backend openmp: '
for format in bmp png exr; do
    expect 0 "$bin/mandelbulb" paramsBulb.dat $small --output a.$format
    expect 0 "$bin/imgdiff" a.$format a.$format
done
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --output a.ppm
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --output a.jpg
[ "$(head -c 3 a.jpg | od -An -tx1)" = " ff d8 ff" ] || fail "a.jpg is no JPEG"
expect 0 "$bin/imgdiff" a.bmp a.png
expect 0 "$bin/imgdiff" a.bmp a.ppm
expect 0 "$bin/imgdiff" a.png a.exr
expect 0 "$bin/mandelbulb" paramsBulb.dat --size 333x217 --backend openmp --output odd.bmp
[ "$(stat -c %s odd.bmp)" = $((54 + 217 * 1000)) ] || fail "size of a padded BMP"
expect 0 "$bin/mandelbulb" paramsBulb.dat --size 1x1 --output one.bmp
"$bin/mandelbulb" paramsBulb.dat $small --output /dev/stdout >piped.bmp 2>/dev/null || fail "writing to /dev/stdout"
expect 0 cmp piped.bmp a.bmp
[ -s stderr ] && fail "something on stderr without a terminal: $(cat stderr)"
"$bin/mandelbulb" - $small --output - <paramsBulb.dat >piped.bmp 2>stderr || fail "from - to -: $(cat stderr)"
expect 0 cmp piped.bmp a.bmp
"$bin/imgdiff" - a.png <a.ppm >stdout || fail "imgdiff of standard input"
sed 's/^imageBulb.bmp/-/' paramsBulb.dat >dash.dat
"$bin/mandelbulb" dash.dat $small --stats dash.json >piped.bmp 2>stderr || fail "a file called -: $(cat stderr)"
expect 0 cmp piped.bmp a.bmp
[ -e ./- ] && fail "a file called - is made"

# With several samples per pixel, the background keeps its colour, and pixels at edges get colours in between.
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --samples 3 --output fine.png
expect 1 "$bin/imgdiff" fine.png a.png
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --samples 1 --output fine.png
expect 0 "$bin/imgdiff" fine.png a.png
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --samples 2 --output fine.exr
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --samples 2 --output fine.png
"$bin/imgdiff" fine.exr fine.png >stdout
grep -q 'at most 1/255' stdout || fail "samples of an EXR are others: $(cat stdout)"
for samples in 0 9 1.5 x; do
    expect 2 "$bin/mandelbulb" paramsBulb.dat $small --samples $samples
done
expect 2 "$bin/mandelbulb" paramsBulb.dat --size 40000x10 --samples 2
says 'expected sides of up to'

# A picture of a region equals that part of the whole picture. The whole picture may be larger than any picture that can
# be rendered at once.
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --region 0,0,40,30 --output region.exr
expect 0 "$bin/imgdiff" region.exr a.exr
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --region 5,10,20x10 --output region.ppm
python3 - <<'PY' || fail "a region is no part of the whole picture"
def rows(name):
    data = open(name, "rb").read()
    kind, size, most, pixels = data.split(b"\n", 3)
    width, height = map(int, size.split())
    return width, height, [pixels[3 * width * y:3 * width * (y + 1)] for y in range(height)]
whole, part = rows("a.ppm"), rows("region.ppm")
assert part[:2] == (20, 10), part[:2]
assert part[2] == [row[3 * 5:3 * 25] for row in whole[2][10:20]]
PY
expect 0 "$bin/mandelbulb" paramsBulb.dat --size 100000x40 --region 50000,20,30,2 --mode fast --precision float \
    --backend openmp --output region.png
for region in 0,0,41,30 0,0,40,31 39,29,2,1 -1,0,2,2 0,0,0,1 0,0,1 0,0,1,1,1 x 0,0,1x; do
    expect 2 "$bin/mandelbulb" paramsBulb.dat $small --region $region
done
says 'expected X,Y,WIDTH,HEIGHT of a part of 40 x 30 pixels'
expect 2 "$bin/mandelbulb" paramsBulb.dat $small --region 0,0,4,4 --eyes 1

expect 1 "$bin/imgdiff" a.bmp image.bmp
expect 1 "$bin/imgdiff" a.bmp odd.bmp
expect 1 "$bin/imgdiff" a.bmp image.bmp --json --map map.png
grep -q '"same": false' stdout || fail "imgdiff --json"
grep -q '"trace": "bin/render .* --size 40x30 --pixel ' stdout || fail "imgdiff --json without a trace"
[ -s map.png ] || fail "imgdiff --map"
expect 2 "$bin/imgdiff" a.bmp missing.bmp
expect 2 "$bin/imgdiff" a.bmp paramsBox.dat
expect 2 "$bin/imgdiff" a.bmp
expect 2 "$bin/imgdiff" a.bmp a.bmp --map map.exr

# --trace prints the steps of a ray and writes no picture. imgdiff prints a command with --trace, which must work.
rm -f traced.png
expect 1 "$bin/imgdiff" a.bmp image.bmp
traced=$(sed -n 's/^why: bin\/render --fractal FRACTAL PARAMS.dat \(--size 40x30 --pixel [0-9]*,[0-9]* --trace\),.*/\1/p' stdout)
[ -n "$traced" ] || fail "imgdiff prints no command: $(cat stdout)"
expect 0 "$bin/render" --fractal mandelbulb paramsBulb.dat $traced --output traced.png
grep -q '^colour .*, as bytes [0-9]* [0-9]* [0-9]*$' stdout || fail "no colour in the trace of $traced"
[ ! -e traced.png ] || fail "a trace draws a picture"
for options in "" "--precision float" "--mode fast"; do
    expect 0 "$bin/mandelbox" paramsBox.dat $small $options --pixel 20,15 --trace
    grep -q 'hit: DE is below the tolerance$' stdout || fail "the ray in the middle does not hit: $options"
done
grep -q '^a trial on openmp chose the step factor$' stdout || fail "a fast trace says nothing of its step factor"
for options in "--trace" "--pixel 3,4" "--pixel 40,3 --trace" "--pixel 3,30 --trace" "--pixel -1,3 --trace" \
    "--pixel 3 --trace" "--pixel 3,x --trace"; do
    expect 2 "$bin/mandelbulb" paramsBulb.dat $small $options
done
says "^--pixel: '3,x' given, expected X,Y of a pixel, from 0,0 at the bottom left to 39,29 at the top right"
expect 2 "$bin/mandelbulb" paramsBulb.dat $small --projection fish
says 'projection: fish not in \{perspective,equirectangular\}'

# Names of version 1 still work.
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --mode fast --pack 1 --estimate counted --without=root,surroundings --output old.png
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --mode fast --simd-width 1 --estimate original \
    --without refinement,shared-occlusion --output new.png
cmp old.png new.png || fail "old names of options and values"
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --precision float --mode fast --threads 3 --simd-width 1 --stats stats.json --output a.png
for text in '"backend": "openmp"' '"precision": "float"' '"mode": "fast"' '"threads": 3' '"simd_width": 1' '"de_calls": [1-9]' \
    '"iterations": [1-9]' '"steps": [1-9]' '"wall": 0'; do
    grep -q "$text" stats.json || fail "statistics without $text"
done

# A scene that is too fine for float: one line warns of this, and the stats say how the scene was rendered.
sed 's/^14.0 8.0 10.0$/-2.0239316 -0.1431710 2.4512503/; s/^0 0 0$/-0.2198636 0.2761599 0.0554219/; s/^-4$/-3.7215097/
     s/^2 0.5 1$/2.1486392 0.7831253 1.4890415/; s/^18 100$/32 100/' paramsBox.dat >fine.dat
expect 0 "$bin/mandelbox" fine.dat --size 61x45 --precision float --mode fast --stats stats.json --output a.png
grep -q "float's digits are too few for this view: .* --precision double" stderr || fail "nothing said of float's digits"
grep -q '"unsettled": 0\.[0-9]*[1-9]' stats.json || fail "statistics without what is unsettled"
expect 0 "$bin/mandelbox" paramsBox.dat --size 61x45 --precision float --mode fast --stats stats.json --output a.png
! grep -q 'shorter steps' stderr || fail "the official scene is called too fine"
grep -q '"step_factor": 0\.95' stats.json || fail "statistics without the steps"
grep -q '"unsettled": 0\.0,' stats.json || fail "the official scene is unsettled in the statistics"

# --version prints one line, with the version in CITATION.cff. Sanitizer builds have no bench.
version=$(sed -n 's/^version: //p' "$source/CITATION.cff")
for program in render mandelbulb mandelbox imgdiff demo bench flythrough; do
    [ -x "$bin/$program" ] || continue
    expect 0 "$bin/$program" --version
    [ "$(wc -l <stdout)" = 1 ] && grep -Eqx "$program $version \(([0-9a-f]{40}|unknown)(, changed)?\)" stdout ||
        fail "$program --version says $(head -c 300 stdout)"
done

for backend in openacc opencl vulkan; do
    "$bin/mandelbulb" --list-devices | grep -q "^$backend *unavailable: not built" || continue
    expect 77 "$bin/mandelbulb" paramsBulb.dat --size 40x30 --backend $backend --output new.bmp
    says 'not built'
done
expect 77 "$bin/mandelbulb" paramsBulb.dat $small --device 5 --output new.bmp
expect 77 "$bin/mandelbulb" paramsBulb.dat --size 40x30 --backend reference --precision float --output new.bmp
"$bin/mandelbulb" --list-devices | grep -q '^openmp *0: ' || fail "--list-devices"

# Wrong arguments.
for arguments in "" "--nonsense" "paramsBulb.dat --backend metal" "paramsBulb.dat --precision half" \
    "paramsBulb.dat --mode slow" "paramsBulb.dat --size 0x5" "paramsBulb.dat --size 5" "paramsBulb.dat --size 0x10x10" \
    "paramsBulb.dat --size -5x5" "paramsBulb.dat --size 5.5x5" "paramsBulb.dat --size 65536x1" "paramsBulb.dat --size x" \
    "paramsBulb.dat --threads -1" "paramsBulb.dat --threads many" "paramsBulb.dat --simd-width 3 --backend openmp" \
    "paramsBulb.dat --device -1" "paramsBulb.dat more.dat"; do
    expect 2 "$bin/mandelbulb" $arguments
done
expect 2 "$bin/render" paramsBulb.dat
expect 2 "$bin/render" --fractal sponge paramsBulb.dat
expect 0 "$bin/mandelbulb" --help
grep -q 'bytes per pixel' stdout || fail "--help gives no memory figure"

# Wrong parameter files: the message begins with the file's name and the line.
expect 2 "$bin/mandelbulb" missing.dat
says '^missing.dat:1: .*expected'
expect 2 "$bin/mandelbulb" .
says '^\.:1: .*directory'
: >empty.dat
expect 2 "$bin/mandelbulb" empty.dat
says '^empty.dat:1: the file ends'
head -c 3000 /dev/urandom >junk.dat
expect 2 "$bin/mandelbulb" junk.dat
says '^junk.dat:[0-9]+: '
head -c 1000000 /dev/zero | tr '\0' 7 >long.dat
expect 2 "$bin/mandelbulb" long.dat
head -c 9000000 /dev/zero >zeros.dat
expect 2 "$bin/mandelbulb" zeros.dat
says '^zeros.dat:'

# Messages about parameter files explain units, comments and super-sampling.
awk '!/^#/ && NF == 1 && !done { print 60; done = 1; next } { print }' paramsBulb.dat >degrees.dat
expect 2 "$bin/mandelbulb" degrees.dat
says "field of view, in units of 65 degrees, is '60', expected"
"$bin/mandelbulb" --help | grep -q '65 degrees' || fail "--help has no unit of the field of view"
sed 's/^imageBulb.bmp/frame #3.bmp/' paramsBulb.dat >comment.dat
expect 2 "$bin/mandelbulb" comment.dat $small
says 'frame: .* # behind a blank'
for number in 0 1; do
    awk -v n=$number '/^imageBulb/ { print n } { print }' paramsBulb.dat >super.dat
    expect 0 "$bin/mandelbulb" super.dat $small --output a.png
    says ":27: warning: '$number' taken as the super-sampling"
    expect 0 "$bin/mandelbulb" super.dat $small --output one.png --samples 1
    expect 0 "$bin/mandelbulb" super.dat $small --output four.png --samples 2
    [ $number = 0 ] && same=one || same=four
    cmp -s a.png $same.png || fail "super-sampling $number draws another picture than $same.png"
    cmp -s one.png four.png && fail "super-sampling changes nothing"
done

# Wrong output files are reported before anything is rendered.
sed 's/^imageBulb.bmp/image/' paramsBulb.dat >noending.dat
expect 2 "$bin/mandelbulb" noending.dat $small
sed 's/^imageBulb.bmp/image.tiff/' paramsBulb.dat >unknown.dat
expect 2 "$bin/mandelbulb" unknown.dat $small
expect 2 "$bin/mandelbulb" paramsBulb.dat $small --output missing/a.bmp
mkdir folder.bmp
expect 2 "$bin/mandelbulb" paramsBulb.dat $small --output folder.bmp
expect 2 "$bin/mandelbulb" paramsBulb.dat $small --stats missing/a.json --output new.bmp
if [ "$(id -u)" != 0 ]; then
    mkdir locked && chmod 555 locked
    expect 2 "$bin/mandelbulb" paramsBulb.dat $small --output locked/a.bmp
fi
expect 2 "$bin/mandelbulb" paramsBulb.dat --size 65535x65535 --output huge.bmp
says 'PNG or EXR'
expect 2 "$bin/mandelbulb" paramsBulb.dat --size 65535x65535 --output huge.exr
says 'MiB of memory'

mkdir gone
(cd gone && rmdir ../gone && "$bin/mandelbulb" "$folder/paramsBulb.dat" $small --output a.bmp 2>"$folder/stderr")
[ $? = 1 ] && [ "$(wc -l <stderr)" = 1 ] || fail "a deleted folder: $(head -c 300 stderr)"

# A file must not be used for two purposes.
cp again.bmp twice.bmp
ln -s twice.bmp link.bmp
ln twice.bmp hard.bmp
cp paramsBulb.dat parameters.bmp
for pair in "new.bmp ./new.bmp" "twice.bmp link.bmp" "link.bmp hard.bmp"; do
    expect 2 "$bin/mandelbulb" paramsBulb.dat $small --output ${pair% *} --stats ${pair#* }
    says 'the same file'
done
expect 2 "$bin/mandelbulb" parameters.bmp $small --output ./parameters.bmp
expect 2 "$bin/mandelbulb" parameters.bmp $small --output new.bmp --stats parameters.bmp
expect 2 "$bin/imgdiff" a.bmp link.bmp --map hard.bmp
expect 2 "$bin/imgdiff" link.bmp a.bmp --map twice.bmp
expect 0 cmp twice.bmp again.bmp
expect 0 cmp parameters.bmp paramsBulb.dat
expect 0 "$bin/mandelbulb" paramsBulb.dat $small --output /dev/null --stats /dev/null

# If a message cannot be written, this is ignored. If a result cannot be written, the program fails.
awk '/^imageBulb/ { print 4 } { print }' paramsBulb.dat >warning.dat
expect 0 "$bin/mandelbulb" warning.dat $small --output kept.bmp
says 'warning: '
for where in '2>/dev/full' '2>&-' '2>&1 | true; exit ${PIPESTATUS[0]}'; do
    rm -f noted.bmp
    expect 0 bash -c "'$bin/mandelbulb' warning.dat $small --output noted.bmp $where"
    cmp -s noted.bmp kept.bmp || fail "no picture, or another, with $where"
    expect 1 bash -c "'$bin/imgdiff' a.bmp odd.bmp $where"
done
for command in "imgdiff a.bmp a.bmp" "imgdiff a.bmp a.bmp --json" "imgdiff --help" "mandelbulb --help" \
    "mandelbulb --list-devices"; do
    for where in '>/dev/full' '>&-'; do
        expect 1 bash -c "'$bin'/$command $where"
        says 'standard output cannot be written'
        [ "$(wc -l <stderr)" = 1 ] || fail "$(wc -l <stderr) lines on stderr: $command $where"
    done
done
expect 2 bash -c "'$bin/mandelbulb' paramsBulb.dat $small --output /dev/stdout >&-"

# Names with control characters, and long values, are printed in one short line.
odd=$'a\n\e[31m'
cp warning.dat "$odd.dat"
expect 0 "$bin/mandelbulb" "$odd.dat" $small --output a.png
[ "$(wc -l <stderr)" = 1 ] || fail "a warning of $(wc -l <stderr) lines"
expect 2 "$bin/mandelbulb" "$odd.none"
for ending in bmp png exr; do
    head -c 300 a.$ending >"$odd.$ending"
    expect 2 "$bin/imgdiff" "$odd.$ending" a.$ending
    says '^a\\n\\x1b\[31m'
done
cp odd.bmp "$odd.bmp"
expect 1 "$bin/imgdiff" "$odd.bmp" a.bmp
[ "$(wc -l <stderr)" = 1 ] || fail "a note of $(wc -l <stderr) lines"
expect 2 "$bin/mandelbulb" paramsBulb.dat --size "$(head -c 100000 /dev/zero | tr '\0' 7)"
[ "$(wc -c <stderr)" -lt 3000 ] || fail "a line of $(wc -c <stderr) bytes"

# A signal while a picture is rendered ends the program by that signal, and no file remains.
sed '0,/^[^#]/s/^[^#].*/90 90 90/' paramsBulb.dat >far.dat
for signal in INT TERM HUP; do
    env --default-signal=INT,TERM,HUP "$bin/mandelbulb" far.dat --size 3000x3000 --backend openmp --output signal.png \
        2>stderr &
    until compgen -G '.mandelmarch-*' >stdout || ! kill -0 $!; do :; done
    kill -STOP $!
    compgen -G '.mandelmarch-*' >stdout || fail "no picture was in the making: $(cat stderr)"
    kill -$signal $!
    kill -CONT $!
    wait $! 2>stderr
    [ $? = $((128 + $(kill -l $signal))) ] || fail "exit code after $signal"
    [ -z "$(find . -name '.mandelmarch-*' -o -name signal.png)" ] || fail "$signal leaves $(ls -A)"
done

# Full disks, simulated by /dev/full and by a limit on file sizes.
expect 1 "$bin/mandelbulb" paramsBulb.dat $small --output /dev/full
says 'No space left'
cp a.bmp kept.bmp
expect 1 bash -c "ulimit -f 8; exec '$bin/mandelbulb' paramsBulb.dat --size 200x200 --backend openmp --output kept.bmp"
says 'File too large'
expect 0 cmp kept.bmp a.bmp
for format in png exr; do
    expect 1 bash -c "ulimit -f 8; exec '$bin/mandelbulb' paramsBulb.dat --size 300x300 --backend openmp --output full.$format"
    [ -e full.$format ] && fail "half a $format"
done
"$bin/mandelbulb" paramsBulb.dat $small --output /dev/stdout 2>stderr | head -c 10 >/dev/null

[ $failures = 0 ] && echo "all well"
exit $((failures > 0))
