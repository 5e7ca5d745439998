# SPDX-License-Identifier: Apache-2.0
# Cases of flythrough: the files that films and stills create and keep, and errors that must be reported before
# rendering.
. "$(dirname "$script")/films.sh"

# All segments of a film are in the store, but not joined yet. The store is then damaged in several ways. In the end the
# film must be complete.
test_damaged_segments() {
    whole
    run 0 render path.json $small --output parts.mp4 --segments 0-1
    damage junk 'head -c $(stat -c %s segment-000001.mp4) /dev/urandom >segment-000001.mp4'
    damage copied 'cp segment-000000.mp4 segment-000001.mp4; cp segment-000000.mp4.made segment-000001.mp4.made'
    damage unknown 'rm segment-000001.mp4.made'
}
damage() {
    cp -r parts.mp4.parts "$1.mp4.parts"
    (cd "$1".mp4.parts/*/ && eval "$2")
    run 0 render path.json $small --output "$1.mp4"
    says "$1.mp4.parts/.*/segment-000001.mp4 is damaged"
    says '1 of 2 segments'
    same_file "$1.mp4" whole.mp4 "after $2"
}

# A complete film is kept. If the film's file has other contents, the film is rendered again, even if the file has the
# size that the film's stamp records.
test_kept_film() {
    whole
    cp whole.mp4 kept
    head -c "$(stat -c %s kept)" /dev/urandom >whole.mp4
    whole
    same_file whole.mp4 kept
    says '2 of 2 segments'
    run 0 render path.json $small --output whole.mp4 --summary summary.json
    says '0 of 2 segments'
    grep -q '"seconds_per_frame": null' summary.json || fail "a film that was there has seconds a frame"
    [ -e whole.mp4.parts ] && fail "parts are left"
}

# Tests outputs that are not ordinary files: a pipe, a link, a dangling link, a device, standard output.
test_outputs() {
    mkdir tmp
    export TMPDIR=$PWD/tmp
    whole
    mkfifo pipe
    timeout 60 cat pipe >piped &
    run 0 render path.json $small --output pipe
    wait $!
    same_file piped whole.mp4
    [ -p pipe ] || fail "the pipe is gone"
    ln -s nothing link.mp4
    run 0 render path.json $small --output link.mp4
    [ -L link.mp4 ] || fail "the link is gone"
    same_file nothing whole.mp4 'through a link'
    run 0 render path.json $small --output /dev/stdout
    same_file stdout whole.mp4
    run 0 render path.json $small --output /dev/null
    [ -e /dev/null.parts ] || [ -e /dev/null.made ] && fail "something is left in /dev"
    [ -z "$(ls -A tmp)" ] || fail "something is left in TMPDIR: $(ls -A tmp)"
    TMPDIR=$PWD/nowhere run 2 render path.json $small --output pipe
    says TMPDIR
}

# Links and pipes that lie at names that flythrough chooses are neither followed nor waited for.
test_planted_files() {
    echo precious >precious
    cp precious kept
    run 0 render path.json $small --output v.mp4 --segments 0-0 --title a
    for name in list.txt title-0.txt; do (cd v.mp4.parts/*/ && ln -s ../../precious $name); done
    mkfifo v.mp4.made
    run 0 render path.json $small --output v.mp4 --title a
    [ -f v.mp4.made ] || fail "the pipe at the stamp stays"
    mkdir stills other
    ln -s ../precious stills/frame-000000.png
    run 0 render path.json $small --stills stills --every 40
    same_file precious kept
    ln -s other w.mp4.parts
    : >other/lock
    run 1 render path.json $small --output w.mp4
    says 'w.mp4.parts: it is a link'
    [ -e other/lock ] || fail "a file behind a link is removed"
    mkfifo font
    MANDELMARCH_FONT=font run 2 render path.json $small --output v.mp4 --title b
    says 'MANDELMARCH_FONT: font is not a file'
}

# If stderr cannot be written, flythrough still makes the film and its summary.
test_streams_that_fail() {
    whole
    expect 0 bash -c "'$program' render path.json $small --output mute.mp4 --summary mute.json 2>/dev/full"
    same_file mute.mp4 whole.mp4
    [ -s mute.json ] || fail "no summary"
    "$program" render path.json $small --output /dev/fd/2 2>&-
    [ $? = 2 ] || fail "another file has the number of a stderr that is closed"
    "$program" audit path.json >/dev/full 2>stderr
    [ $? = 1 ] || fail "an audit that cannot be printed is no failure"
}

# Existing stills are kept only if they are complete and belong to this film.
test_stills() {
    stills() { run 0 render "$@" --every 20; }
    make_path other.json 30 0.03
    stills path.json $small --stills st
    cp -rp st first
    stills path.json $small --stills st
    [ "$(cd st && ls -l --time-style=full-iso)" = "$(cd first && ls -l --time-style=full-iso)" ] || fail "stills are made twice"
    : >st/frame-000000.png
    head -c 1000 /dev/urandom >st/frame-000020.png
    cp st/frame-000060.png st/frame-000040.png
    stills path.json $small --stills st
    diff -r st first >/dev/null || fail "stills that were damaged stay"
    local now
    for now in "other.json $small" "path.json $small --mode exact"; do
        stills $now --stills st
        stills $now --stills new
        diff -r st new >/dev/null || fail "stills of something else stay: $now"
        rm -rf new
    done
    grep -q 'another film' stderr && fail "stills of another film, but they were replaced"
    run 0 render path.json ${small/32x16/64x32} --stills st --every 60
    says 'st has 2 pictures of another film, look, size'
    # EXR stills are the same means of samples, with depths.
    for now in png exr; do
        run 0 render path.json ${small/samples 1/samples 2} --frames 0-0 --stills light --still-format $now
    done
    "$bin/imgdiff" light/frame-000000.png light/frame-000000.exr >difference
    grep -q ', 0 by more than 2/255' difference || fail "an EXR still differs: $(cat difference)"
    grep -aq 'Z.*displayed.R' light/frame-000000.exr || fail "an EXR still has no depth"
    run 2 render path.json ${small/samples 1/samples 1.5} --stills light --still-format exr
    says "^--samples: 1.5 given, expected a whole number"
}

# Tests errors that are reported in one line, before anything is rendered.
test_errors() {
    : >file
    run 77 film ${small/openmp/openmp --device 99}
    local arguments
    for arguments in "--size 15x16" "--size 60000x60000" "--output nowhere/film.mp4" "--map nowhere/map.json" \
        "--stills file" "--stills stills --summary summary.json" "--power 8:"; do
        run 2 film $small $arguments
    done
    run 2 film nowhere/path.json $small
    for arguments in "--power 8:5 --scale 2:3" "--fractal box --power 8:5" "--map new.json"; do
        run 2 plan new.json $arguments
    done
    run 2 audit path.json --json path.json
    for arguments in "--power 8:5" "--output ./path.json" "--stills st --segments 1-0" "--output v.mp4 --summary v.mp4.made"; do
        run 2 render path.json $small $arguments
    done
    cp path.json v.mp4.made
    run 2 render v.mp4.made $small --output v.mp4
    says 'v.mp4.made: the stamp of --output and PATH are the same file'
    # Backends that do not draw on the host's cores do not use its threads.
    run 2 render path.json ${small/openmp/reference} --output v.mp4
    says '--threads: not supported by backend reference'
}

# If the line breaks of the title or the font change, an existing film is rendered again.
test_titles() {
    cp /usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf "it's: 100 %, [a] font; \\.ttf"
    run 0 render path.json $small --output titled.mp4 --title a --authors $'b\nc'
    MANDELMARCH_FONT="it's: 100 %, [a] font; \\.ttf" run 0 render path.json $small --output titled.mp4 --title $'a\nb' --authors c
    says '2 of 2 segments'
}

# Starts flythrough with a fake ffmpeg, given by a relative name. The fake waits at the first segment until the file
# `go` exists.
start_waiting() {
    cat >slow <<'END'
#!/bin/sh
case "$*" in *.part-0*) : >begun; while [ ! -e "$GO" ] && kill -0 $PPID; do sleep 0.05; done ;; esac
exec ffmpeg "$@"
END
    chmod +x slow
    GO=$PWD/go MANDELMARCH_FFMPEG=./slow "$program" render path.json $small --output two.mp4 2>stderr0 &
    until ls two.mp4.parts/*/begun >/dev/null 2>&1; do sleep 0.05; done
}

test_two_films_of_one_name() {
    whole
    make_path other.json 30 0.03
    start_waiting
    run 1 render other.json $small --output two.mp4
    says 'two.mp4: another run'
    : >go
    wait $! || fail "a film beside another: $(cat stderr0)"
    same_file two.mp4 whole.mp4
}

test_a_signal_leaves_no_partial_file() {
    start_waiting
    touch "$(ls -d two.mp4.parts/*/)/.part-000000-$(hostname)-$!.mp4"
    kill -TERM $!
    wait $! && fail "a signal ended nothing"
    ls two.mp4.parts/*/.[pm]* 2>/dev/null && fail "a signal leaves files"
}

# ffmpeg is missing, fails or hangs: while flythrough checks ffmpeg, or while ffmpeg encodes a segment.
test_bad_encoders() {
    MANDELMARCH_FFMPEG=false run 1 render path.json $small --output none.mp4
    says 'does not work'
    [ -e none.mp4.parts ] && fail "work was begun without an encoder"
    MANDELMARCH_FFMPEG_TIMEOUT=abc run 2 render path.json $small --output none.mp4
    says "^MANDELMARCH_FFMPEG_TIMEOUT: 'abc' given, expected seconds"
    cat >fake <<'END'
#!/bin/sh
case "$*" in
    *"$HANG"*) exec sleep 100 ;;
    *lavfi*) exit ;;
    *.part-0*) [ -z "$FAIL" ] || exit 3 ;;
esac
exec ffmpeg "$@"
END
    chmod +x fake
    export MANDELMARCH_FFMPEG=./fake
    hangs() {
        HANG=$1 MANDELMARCH_FFMPEG_TIMEOUT=1 "$program" render path.json $small --output none.mp4 2>stderr
        [ $? = 1 ] || fail "exit code of an ffmpeg that hangs: $1"
        says "$2: no answer in 1 s"
    }
    hangs lavfi 'fake does not work'
    hangs .part-0 'none.mp4: the encoder failed'
    HANG=none run 0 render path.json $small --output none.mp4 --segments 0-1
    hangs concat 'none.mp4: ffmpeg failed'
    # A parent that ignores SIGCHLD does not hide how processes end.
    FAIL=1 HANG=none expect 1 env --ignore-signal=CHLD "$program" render path.json $small --output failed.mp4
    says 'failed.mp4: the encoder failed: exit code 3'
}

# A program found through a relative folder of PATH is the same in the folder of parts, and gets no variables of OpenMP,
# which would bind it to one core.
test_path_and_environment() {
    mkdir rel
    printf '#!/bin/sh\nPATH=%s\nenv >>"%s"\nexec ffmpeg "$@"\n' "$PATH" "$PWD/variables" >rel/ffmpeg
    chmod +x rel/ffmpeg
    expect 0 env OMP_PROC_BIND=true GOMP_CPU_AFFINITY=0 KMP_AFFINITY=none OWN=1 PATH=rel "$program" render path.json $small \
        --output rel.mp4
    grep -q '^OWN=1' variables || fail "no variables: $(cat variables)"
    grep -E '^(OMP|GOMP|KMP)_' variables && fail "ffmpeg has variables of OpenMP"
    # Without /proc the program finds its own file, too. The name of the processor is unknown, so the film is made anew.
    cp rel.mp4 kept
    unshare -rm sh -c 'mount -t tmpfs none /proc' 2>/dev/null || return 0
    expect 0 unshare -rm sh -c 'mount -t tmpfs none /proc && exec "$@"' - "$program" render path.json $small --output rel.mp4
    same_file rel.mp4 kept
}

# If the program ends by a signal, the processes that it has started end, too. SIGKILL spares those that its children
# have started.
test_no_orphans() {
    printf '#!/bin/sh\ncase "$*" in *.part-0*) echo $$ >../../self; sleep 60 & echo $! >../../other; wait ;; esac\nexec ffmpeg "$@"\n' >slow
    chmod +x slow
    local signal
    for signal in KILL TERM; do
        rm -f self other
        MANDELMARCH_FFMPEG=./slow "$program" render path.json $small --output two.mp4 2>stderr0 &
        until [ -s other ]; do sleep 0.05; done
        kill -$signal $!
        wait $! && fail "$signal ended nothing"
        sleep 1
        runs self && fail "$signal leaves a child"
        runs other && [ $signal = TERM ] && fail "$signal leaves a child's child"
        runs other && kill "$(cat other)"
    done
}
runs() { grep -q . /proc/"$(cat "$1")"/cmdline 2>/dev/null; }  # not if it is a zombie

# The encoder writes half a file and exits with 0, as ffmpeg does if there is no space for the file's end.
test_half_a_segment() {
    whole
    cat >halving <<'END'
#!/bin/sh
ffmpeg "$@" || exit 1
for last; do :; done
case "$last" in .part-0*) truncate -s -100 "$last" ;; esac
END
    chmod +x halving
    MANDELMARCH_FFMPEG=$PWD/halving run 1 render path.json $small --output half.mp4
    says 'an incomplete file'
    run 0 render path.json $small --output half.mp4
    same_file half.mp4 whole.mp4
}

# A segment that is exchanged while another one is rendered does not become a part of the film.
test_exchanged_segment() {
    whole
    printf '#!/bin/sh\ncase "$*" in *.part-000001*) echo junk >segment-000000.mp4 ;; esac\nexec ffmpeg "$@"\n' >exchanging
    chmod +x exchanging
    MANDELMARCH_FFMPEG=$PWD/exchanging run 1 render path.json $small --output part.mp4
    says 'part.mp4.parts/.*/segment-000000.mp4: changed while the film was made'
    run 0 render path.json $small --output part.mp4
    same_file part.mp4 whole.mp4
}

# On a file system without locks, films are made without one, and a message says so.
test_no_locks() {
    whole
    echo '#include <errno.h>
        int flock(int file, int how) { (void)file, (void)how; errno = ENOLCK; return -1; }' | cc -shared -fPIC -x c -o none.so -
    LD_PRELOAD=$PWD/none.so run 0 render path.json $small --output none.mp4
    says 'none.mp4.parts/lock: No locks available, so a second run of this name would not be noticed'
    same_file none.mp4 whole.mp4
}

# Before a long film, time, disk space and memory are printed. The film and its segments need no more disk than that.
test_forecast() {
    make_path long.json 30 0.002 600
    run 0 render long.json ${small/32x16/128x72} --output long.mp4
    says 'film: 600 frames of 128 x 72 pixels, .* s each of 8 tried: .* in all'
    says 'film: needs up to [0-9.]* MiB of disk, [0-9.]* .iB are free in .*; 300.0 MiB of memory'
    local most
    most=$(sed -n 's/.*needs up to \([0-9]*\)\.\([0-9]\) MiB.*/\1\2/p' stderr)
    [ $((3 * $(stat -c %s long.mp4))) -le $((most * 104858)) ] || fail "$most tenths of a MiB, but the film has $(stat -c %s long.mp4) bytes"
    [ $((30 * $(stat -c %s long.mp4))) -gt $((most * 104858)) ] || fail "$most tenths of a MiB are ten times too much"
    # A short film has no forecast.
    run 0 render path.json $small --output short.mp4
    grep -q MiB stderr && fail "a forecast for two segments"
    return 0
}

# The disk is full, which a limit on file sizes simulates.
test_full_disk() {
    (ulimit -f 12; exec "$program" render path.json ${small/32x16/320x180} --output full.mp4 2>stderr)
    [ $? = 1 ] || fail "a full disk gives another exit code than 1"
    [ "$(wc -l <stderr)" -le 3 ] || fail "a full disk says too much: $(cat stderr)"
    says 'the encoder failed|an incomplete file'
    ls full.mp4.parts/*/.part-* >/dev/null 2>&1 && fail "a full disk leaves parts"
    [ -e full.mp4 ] && fail "a full disk leaves half a film"
}
