#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# film_test.sh FLYTHROUGH: which files films and stills create and keep, kinds of output files, and errors that must be
# reported before the work.
. "$(dirname "$0")/films.sh"
mkdir tmp
export TMPDIR=$PWD/tmp

make_path path.json 30 0.02
make_path other.json 30 0.03
run 0 render path.json $small --output whole.mp4
run 0 render other.json $small --output other.mp4

# The segment store of a film that is not joined yet is damaged in several ways; the film must be complete in the end.
run 0 render path.json $small --output parts.mp4 --segments 0-1
damage() {
    cp -r parts.mp4.parts "$1.mp4.parts"
    cd "$1".mp4.parts/*/ || return
    eval "$2"
    cd ../..
    run 0 render path.json $small --output "$1.mp4"
    says "$1.mp4.parts/.*/segment-000001.mp4 is damaged"
    says '1 of 2 segments'
    same "$1.mp4" whole.mp4 "$2"
}
damage cut 'truncate -s -100 segment-000001.mp4'
damage junk 'head -c $(stat -c %s segment-000001.mp4) /dev/urandom >segment-000001.mp4'
damage copied 'cp segment-000000.mp4 segment-000001.mp4; cp segment-000000.mp4.made segment-000001.mp4.made'
damage unknown 'rm segment-000001.mp4.made'

# The film's file has the size that its stamp records, but other contents.
cp whole.mp4 kept
head -c "$(stat -c %s kept)" /dev/urandom >whole.mp4
run 0 render path.json $small --output whole.mp4
same whole.mp4 kept 'junk of the same size'
says '2 of 2 segments'
run 0 render path.json $small --output whole.mp4
says '0 of 2 segments'

# Kinds of outputs: a pipe, a link, a dangling link, a device, standard output.
mkfifo pipe
timeout 60 cat pipe >piped &
run 0 render path.json $small --output pipe
wait %1
same piped whole.mp4 'through a pipe'
[ -p pipe ] || fail "the pipe is gone"
echo old >target
for target in target nothing; do
    ln -s $target link.mp4
    run 0 render path.json $small --output link.mp4
    [ -L link.mp4 ] || fail "the link is gone"
    same $target whole.mp4 'through a link'
    rm link.mp4
done
run 0 render path.json $small --output /dev/stdout
same stdout whole.mp4 'through stdout'
run 0 render path.json $small --output /dev/null
[ -e /dev/null.parts ] || [ -e /dev/null.made ] && fail "something is left in /dev"
[ -z "$(ls -A tmp)" ] || fail "something is left in TMPDIR: $(ls -A tmp)"
run 2 render path.json $small --output pipe --segments 0-1
TMPDIR=$PWD/nowhere run 2 render path.json $small --output pipe
says TMPDIR
if [ -w /dev/shm ]; then
    shm=$(mktemp -d -p /dev/shm)
    run 0 render path.json $small --output "$shm/film.mp4"
    same "$shm/film.mp4" whole.mp4 'in /dev/shm'
    rm -rf "$shm"
fi

# If stderr cannot be written, the film and its summary are made nevertheless.
for to in '2>/dev/full' '2>&-' '2>&1 | true'; do
    rm -f mute* code
    eval "{ '$program' render path.json $small --output mute.mp4 --summary mute.json; echo \$? >code; } $to"
    [ "$(cat code)" = 0 ] || fail "exit code $(cat code) with $to"
    same mute.mp4 whole.mp4 "$to"
    [ -s mute.json ] || fail "no summary with $to"
done
"$program" render path.json $small --output /dev/fd/2 2>&-
[ $? = 2 ] || fail "another file has the number of a stderr that is closed"
"$program" audit path.json >/dev/full 2>stderr
[ $? = 1 ] || fail "an audit that cannot be printed is no failure"

# Existing stills are kept only if they are complete and belong to this film.
run 0 render path.json $small --stills st --every 20
cp -r st first
run 0 render path.json $small --stills st --every 20
[ "$(cd st && ls -l --time-style=full-iso)" = "$(cd first && ls -l --time-style=full-iso)" ] && fail "cp keeps times"
cp -rp st before
run 0 render path.json $small --stills st --every 20
[ "$(cd st && ls -l --time-style=full-iso)" = "$(cd before && ls -l --time-style=full-iso)" ] || fail "stills are made twice"
: >st/frame-000000.png
head -c 1000 /dev/urandom >st/frame-000020.png
cp st/frame-000060.png st/frame-000040.png
run 0 render path.json $small --stills st --every 20
diff -r st first >/dev/null || fail "stills that were damaged stay"
run 0 render other.json $small --stills others --every 20
for now in "other.json $small" "other.json ${small/32x16/48x16}" "path.json $small --mode exact" "path.json $small"; do
    run 0 render $now --stills st --every 20
    run 0 render $now --stills new --every 20
    diff -r st new >/dev/null || fail "stills of something else stay: $now"
    rm -rf new
done
run 0 render path.json $small --stills st --every 20 --still-format jpeg
: >st/frame-000000.jpg
run 0 render path.json $small --stills st --every 20 --still-format jpeg
[ -s st/frame-000000.jpg ] || fail "an empty JPEG stays"

# Errors that are reported before the work, in one line.
: >file
run 2 film $small --size 15x16
run 2 film $small --size 14x14
run 2 film $small --output nowhere/film.mp4
run 2 film $small --summary nowhere/summary.json
run 2 film $small --map nowhere/map.json
run 2 film $small --json nowhere/audit.json
run 2 film nowhere/path.json $small
run 2 film $small --segments 500-600
run 2 film $small --size 60000x60000
run 77 film ${small/openmp/openmp --device 99}
run 2 film $small --stills file
run 2 film $small --stills stills --summary summary.json
run 2 film $small --power 8:
run 2 film $small --power 0s=8,300s=5
run 2 plan new.json --power 8:5 --scale 2:3
run 2 plan new.json --fractal box --power 8:5
run 2 render path.json $small --power 8:5
run 2 plan nowhere/path.json
run 2 plan new.json --map nowhere/map.json
run 2 audit path.json --json nowhere/audit.json
run 2 audit path.json --json path.json
run 2 render path.json $small --output ./path.json
run 2 render path.json $small --output v.mp4 --summary "$PWD/v.mp4"
run 2 plan new.json --map new.json
run 2 render path.json $small --stills st --segments 1-0
run 2 render path.json $small --stills st --segments 5-9
says '5-9'

# With another title, other line breaks or another font, the film is another one and is rendered again.
cp /usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf "it's: 100 %, [a] font; \\.ttf"
run 0 render path.json $small --output titled.mp4 --title a --authors $'b\nc'
cp titled.mp4 first.mp4
run 0 render path.json $small --output titled.mp4 --title $'a\nb' --authors c
says '2 of 2 segments'
MANDELMARCH_FONT="it's: 100 %, [a] font; \\.ttf" run 0 render path.json $small --output titled.mp4 --title $'a\nb' --authors c
says '2 of 2 segments'

# A fake ffmpeg, given by a relative name, which waits until a file exists.
cat >slow <<'END'
#!/bin/sh
case "$*" in *.part-0*) : >begun; while [ ! -e "$GO" ] && kill -0 $PPID; do sleep 0.05; done ;; esac
exec ffmpeg "$@"
END
chmod +x slow
export GO=$PWD/go
MANDELMARCH_FFMPEG=./slow "$program" render path.json $small --output two.mp4 2>stderr0 &
until ls two.mp4.parts/*/begun >/dev/null 2>&1; do sleep 0.05; done
run 1 render other.json $small --output two.mp4
says 'two.mp4: another run'
: >go
wait %1 || fail "a film beside another: $(cat stderr0)"
same two.mp4 whole.mp4 'beside another'

# After a signal, no partial file remains.
rm go
MANDELMARCH_FFMPEG=./slow "$program" render path.json $small --output ended.mp4 2>stderr &
until ls ended.mp4.parts/*/begun >/dev/null 2>&1; do sleep 0.05; done
touch "$(ls -d ended.mp4.parts/*/)/.part-000000-$(hostname)-$!.mp4"
kill -TERM $!
wait $! && fail "a signal ended nothing"
ls ended.mp4.parts/*/.[pm]* 2>/dev/null && fail "a signal leaves files"

# An ffmpeg that never answers: when flythrough checks it, and when it encodes a segment.
printf '#!/bin/sh\nexec sleep 100\n' >silent
chmod +x silent
export MANDELMARCH_FFMPEG_TIMEOUT=0.5
MANDELMARCH_FFMPEG=./silent run 1 render path.json $small --output none.mp4
says 'no answer in 0.5 s'
sed -i 's/sleep 0.05/exec sleep 100/' slow
MANDELMARCH_FFMPEG=./slow run 1 render path.json $small --output none.mp4
says 'no answer in 0.5 s'
finish
