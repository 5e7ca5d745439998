# SPDX-License-Identifier: Apache-2.0
# Cases of flythrough: container formats, frame rates, parts of a path, titles, tags for players, and job arrays.
. "$(dirname "$script")/films.sh"
# probe FILE ENTRIES: prints these entries of the film's stream.
probe() { ffprobe -v error -select_streams v -count_frames -show_entries "stream=$2" -of csv=p=0 "$1"; }

# The file extension selects the container format. Each film has all of its frames, at the frame rate of the path.
test_containers() {
    local kind film got name
    for kind in mp4:h264 mkv:h264 webm:vp9 gif:gif MKV:h264; do
        film=kind.${kind%:*}
        run 0 render path.json $small --frames 50-59 --output "$film"
        got=$(probe "$film" codec_name,r_frame_rate,nb_read_frames)
        # GIF times are in hundredths of a second.
        [ "$got" = "${kind#*:},30/1,10" ] || [[ $got = gif,*,10 ]] || fail "$film has $got"
    done
    # A name of a size stands for the panorama of this width.
    run 0 render path.json ${small/32x16/720p} --projection equirectangular --frames 0-0 --output wide.mp4
    [[ $(probe wide.mp4 width,height) = 1280,640* ]] || fail "a panorama of 720p has $(probe wide.mp4 width,height)"
    for name in film film.avi; do
        run 2 render path.json $small --output $name
        says 'expected .mp4, .mkv, .webm or .gif'
    done
}

test_frame_rates() {
    local rate got
    for rate in 24 60; do
        make_path rate.json $rate 0.02
        run 0 render rate.json $small --frames 0-1 --output rate.mp4 --title t
        got=$(probe rate.mp4 r_frame_rate,nb_read_frames)
        [ "$got" = "$rate/1,$((2 + 4 * rate))" ] || fail "a path of $rate frames a second gives $got"
    done
    run 2 render rate.json $small --output rate.gif
    says 'a GIF of 60 frames a second, expected at most 50'
}

# Renders some frames of a path, as stills and as a film.
test_parts_of_a_path() {
    run 0 render path.json $small --stills stills --frames 10-12
    [ "$(ls stills | grep -v made | tr '\n' ' ')" = "frame-000010.png frame-000011.png frame-000012.png " ] ||
        fail "--frames 10-12 gives $(ls stills)"
    run 0 render path.json $small --stills all
    same_file stills/frame-000011.png all/frame-000011.png
    run 0 render path.json $small --output part.mkv --frames 30-33
    [ "$(probe part.mkv nb_read_frames)" = 4 ] || fail "a film of four frames has others"
    # The same frames by seconds, at 30 frames a second.
    run 0 render path.json $small --output seconds.mkv --from 1 --to 1.1333
    same_file part.mkv seconds.mkv "frames 30-33 and seconds 1 to 1.13"
    run 2 render path.json $small --output part.mp4 --from 2 --to 3
    says '2 to 3 s given, expected a part of the 2.13'
    # This straight flight passes no narrow place.
    run 2 render path.json $small --output part.mp4 --chapter passages
    says 'passages given, but this flight of 64 frames has 0 narrow places'
    local range
    for range in 60-64 5-3 x; do run 2 render path.json $small --output part.mp4 --frames $range; done
    says 'expected A-B'
}

# A look is given by its number, its name or a file. A film with another look is made again.
test_looks() {
    local look
    for look in 3 coral "$source/scenes/coral.look"; do
        run 0 render path.json $small --look "$look" --stills stills --frames 10-10
        [ -e coral.png ] || cp stills/frame-000010.png coral.png
        same_file stills/frame-000010.png coral.png "the look $look"
    done
    cp "$source/scenes/coral.look" my.look
    run 0 render path.json $small --look my.look --output film.mkv
    cp film.mkv coral.mkv
    sed -i 's/^exposure .*/exposure 2/' my.look
    run 0 render path.json $small --look my.look --output film.mkv
    cmp -s film.mkv coral.mkv && fail "a film stays though its look file has changed"
    run 2 render path.json $small --look nowhere.look
    says 'nowhere.look: No such file or directory, expected a look file'
    run 2 render path.json $small --look 99
    says "look: '99' given, expected a whole number from 0 to [0-9]+$"
}

# A preview has every eighth frame, a film with --every N every N-th frame.
test_previews() {
    run 0 preview path.json
    [ "$(probe preview.mp4 width,height,nb_read_frames)" = 480,270,8 ] || fail "a preview has $(probe preview.mp4 width,height,nb_read_frames)"
    run 0 render path.json $small --every 20 --frames 10-59 --output every.mkv
    [ "$(probe every.mkv nb_read_frames)" = 3 ] || fail "every 20th of 50 frames gives $(probe every.mkv nb_read_frames)"
}

# Jobs of an array render different segments at the same time. The range of the last one may go beyond the last segment.
test_job_arrays() {
    whole
    "$program" render path.json $small --output array.mp4 --segments 0-0 2>stderr0 &
    "$program" render path.json $small --output array.mp4 --segments 1-9 2>stderr || fail "segments 1-9: $(cat stderr)"
    wait $! || fail "segments 0-0: $(cat stderr0)"
    says '1 of 2 segments.*not joined'
    run 0 render path.json $small --output array.mp4
    says '0 of 2 segments'
    same_file array.mp4 whole.mp4
    # A task behind the film's end has nothing to do.
    run 0 render path.json $small --output array2.mp4 --segments 2-9
    says '0 of 2 segments'
    # Arguments of the script behind the film are options, also such with blanks.
    ln -s "$bin" bin
    SLURM_ARRAY_TASK_ID=0 expect 0 bash "$source/flight/slurm/array.sbatch" path.json titled.mp4 1 $small --title "My Film"
    run 0 render path.json $small --output titled.mp4 --title "My Film"
    says '1 of 2 segments'
    # Slurm's tasks that do not find each other do not make the same film, unless each has its segments.
    SLURM_NTASKS=3 run 2 render path.json $small --output alone.mp4
    says '^SLURM_NTASKS: 3 tasks were started, but each finds itself alone'
    SLURM_NTASKS=3 run 0 render path.json $small --output alone.mp4 --segments 1-1
    # A message reports that the store has segments made with other instructions.
    local other
    other=$(other_instructions)
    MANDELMARCH_INSTRUCTIONS=$other run 0 render path.json $small --output mixed.mp4 --segments 0-0
    run 0 render path.json $small --output mixed.mp4 --segments 1-1
    says "mixed.mp4.parts/.* has 1 segments of another film.*instructions: '$other', here 'all of the machine'"
}

# Tests that titles are complete, are shown once for each eye, and use only letters of the font. white FILM WIDTH
# [eyes]: checks that at 2 s there is white text, in the middle and not at the picture's edges. With `eyes`, the text
# must be the same in both halves of the picture.
white() {
    ffmpeg -v error -ss 2 -i "$1" -frames:v 1 -pix_fmt gray -f rawvideo - | python3 -c '
import sys
width = int(sys.argv[1])
data = sys.stdin.buffer.read()
columns = {i % width for i, grey in enumerate(data) if grey > 160}
assert columns, "no text"
if sys.argv[2] == "eyes":
    half = width // 2
    left, right = {c for c in columns if c < half}, {c - half for c in columns if c >= half}
    assert left == right, (sorted(left), sorted(right))
    columns, width = left, half
assert min(columns) > 0.02 * width and max(columns) < 0.98 * width, (min(columns), max(columns), width)
assert abs(min(columns) + max(columns) - width) < 0.05 * width, "not in the middle"
' "$2" "${3:-}"
}
test_titles() {
    local size middle="--samples 1 --backend openmp --frames 0-1 --authors A.B.C."
    for size in 640x360 180x320; do
        run 0 render path.json $middle --size "$size" --output title.mp4 --title "The Flight through the Mandelbulb of Gro"
        white title.mp4 "${size%x*}" || fail "a long title at $size"
    done
    run 0 render path.json $middle --size 640x180 --stereo --output title.mp4 --title "Inside the Mandelbulb"
    white title.mp4 640 eyes || fail "a title for two eyes"
    run 2 render path.json $middle --size 640x360 --output none.mp4 --title $'\xe5\x88\x86\xe5\xbd\xa2'
    says 'lacks .*U\+5206'
    run 2 render path.json $small --output none.mp4 --title t --authors $'\xe6\x9d\x8e'
    says '--authors: .*U\+674E'
}

# A film that shows all directions, or that is for two eyes, has the tags by which players recognise such films.
tags() { ffprobe -v error -show_entries stream_side_data_list "$1" | grep -E '^(projection|type|side_data_type)=' | tr '\n' ' '; }
tagged() {
    local film=$1 tag
    shift
    for tag in "$@"; do tags "$film" | grep -q "$tag" || fail "$film is not tagged: $(tags "$film")"; done
}
test_tags() {
    local kind sphere="--backend openmp --frames 0-1 --projection equirectangular"
    for kind in mp4 mkv webm; do
        run 0 render path.json $sphere --size 64x32 --output sphere.$kind
        tagged sphere.$kind 'projection=equirectangular'
        run 0 render path.json $small --frames 0-1 --stereo --output eyes.$kind
        tagged eyes.$kind 'type=side by side'
    done
    run 0 render path.json $sphere --size 256x64 --stereo --output both.mp4
    tagged both.mp4 'projection=equirectangular' 'type=side by side'
    run 2 render path.json $sphere --size 128x64 --stereo --output none.mp4
    says '128 x 64 pixels given, expected 4 times as wide as high'
    grep -q sv3d sphere.mp4 || fail "sphere.mp4 has no box sv3d"
    run 0 render path.json $small --frames 0-1 --output usual.mp4
    [ -z "$(tags usual.mp4)" ] || fail "a usual film is tagged: $(tags usual.mp4)"
}
