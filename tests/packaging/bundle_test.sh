#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bundle_test.sh BUILD SOURCE: a bundle made without drivers is complete, runs from any folder, and renders pictures
# with the same bits as the build.
set -uo pipefail
build=$(realpath "$1")
source=$(realpath "$2")
command -v patchelf >/dev/null || { echo "no patchelf, which makes bundles"; exit 77; }
. "$source/tests/failures.sh"
cmake --build "$build" --target bundle_program >"$folder/log" 2>&1 || { tail "$folder/log"; exit 1; }
ARCHIVE=no "$source/packaging/bundle" "$build" "$folder/made" OFF >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
# Move the bundle to another folder than the one it was made in.
mkdir "$folder/else where"
mv "$folder"/made/* "$folder/else where/bundle"
bundle="$folder/else where/bundle"
in_bundle() { (cd "$folder" && env -i PATH=/usr/bin:/bin "$bundle/bin/$1" "${@:2}"); }

# outside: prints the libraries that are found outside the bundle, except glibc's. There must be none.
outside() {
    env -i ldd "$bundle/bin/mandelmarch" | grep -vF "$bundle/" |
        grep -vE 'linux-vdso|/ld-linux|/lib(c|m|dl|pthread|rt)\.so|^\s*$'
}
[ -z "$(outside)" ] || fail "from outside: $(outside)"
while read -r file; do
    rpath=$(patchelf --print-rpath "$file")
    [[ ":$rpath" =~ ^(:\$ORIGIN[^:]*)+$ ]] || fail "$file: the path to libraries is '$rpath'"
done < <(find "$bundle" -type f \( -name '*.so*' -o -name mandelmarch \))
[ "$(du -sm --apparent-size "$bundle" | cut -f1)" -lt 60 ] || fail "$(du -sm "$bundle") MB"

# Each file has its licence, and the README names glibc's version.
tail -n +2 "$bundle/MANIFEST.tsv" | while IFS=$'\t' read -r file bytes package version licence; do
    { [ "$bytes" = - ] || [ "$(stat -c %s "$bundle/$file")" = "$bytes" ]; } && [ -n "$package" ] && [ -n "$version" ] && [ -s "$bundle/$licence" ] ||
        echo "$file $bytes $package $version $licence"
done >"$folder/bad"
[ -s "$folder/bad" ] && fail "MANIFEST.tsv: $(cat "$folder/bad")"
find "$bundle/lib" -name '*.so*' -printf '%P\n' | while read -r name; do
    grep -q "^lib/$name	" "$bundle/MANIFEST.tsv" || echo "$name"
done >"$folder/bad"
[ -s "$folder/bad" ] && fail "not in MANIFEST.tsv: $(cat "$folder/bad")"
grep -qE 'glibc 2\.[0-9]+ or newer' "$bundle/README.md" || fail "README.md does not say which glibc it wants"
grep -q '@' "$bundle/README.md" && fail "README.md: $(grep -m1 '@' "$bundle/README.md")"

# Each program starts by its own name and as `mandelmarch PROGRAM`. Pictures have the same bits as those of the build.
for program in render mandelbulb mandelbox imgdiff demo bench flythrough; do
    in_bundle $program --version >/dev/null || fail "$program does not start"
    in_bundle mandelmarch $program --version >/dev/null || fail "mandelmarch $program does not start"
done
in_bundle mandelmarch nothing >/dev/null 2>&1
[ $? = 2 ] || fail "an unknown program is not exit code 2"
small="--size 97x61 --backend openmp"
in_bundle mandelbox "$bundle/paramsBox.dat" $small --output a.exr || fail "no picture"
"$build/bin/mandelbox" "$source/paramsBox.dat" $small --output "$folder/b.exr" || fail "no picture from the build"
in_bundle imgdiff a.exr b.exr >/dev/null || fail "other bits than the build's"
in_bundle bench --backend openmp --fractal box --precision float --size 32x24 --repetitions 2 --runs 2 --json bench.json \
    >/dev/null 2>"$folder/stderr" || fail "bench: $(cat "$folder/stderr")"
in_bundle demo --side 16 >/dev/null 2>&1 || fail "demo"
# If there is no ffmpeg, one line on stderr says so.
(cd "$folder" && env -i PATH=/nowhere "$bundle/bin/flythrough" film --frames 30 --size 64x36 --output film.mp4) 2>"$folder/stderr"
[ $? = 1 ] && [ "$(grep -c ffmpeg "$folder/stderr")" = 1 ] || fail "without ffmpeg: $(cat "$folder/stderr")"

# Negative control: without one of the bundle's libraries the programs miss it, so they do not use the machine's
# library.
mv "$bundle/lib/libOpenEXR"* "$folder/"
[ -n "$(outside)" ] || fail "a library that is away is not missed"
finish
