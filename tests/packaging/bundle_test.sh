# SPDX-License-Identifier: Apache-2.0
# Case run by tests/cases.sh with BUILD SOURCE: a bundle made without drivers is complete, runs from any folder, and
# renders pictures with the same bits as the build.
build=$1
source=$2

test_bundle() {
    cmake --build "$build" --target bundle_program >log 2>&1 || { tail log; exit 1; }
    ARCHIVE=no "$source/packaging/bundle" "$build" "$PWD/made" OFF >log 2>&1 || { cat log; exit 1; }
    # Moves the bundle away from the folder in which it was made.
    mkdir "else where"
    mv made/* "else where/bundle"
    bundle="$PWD/else where/bundle"
    in_bundle() { env -i PATH=/usr/bin:/bin "$bundle/bin/$1" "${@:2}"; }

    # outside: prints the libraries that the program finds outside the bundle, except glibc's. There must be none.
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
    done >bad
    [ -s bad ] && fail "MANIFEST.tsv: $(cat bad)"
    find "$bundle/lib" -name '*.so*' -printf '%P\n' | while read -r name; do
        grep -q "^lib/$name	" "$bundle/MANIFEST.tsv" || echo "$name"
    done >bad
    [ -s bad ] && fail "not in MANIFEST.tsv: $(cat bad)"
    grep -qE 'glibc 2\.[0-9]+ or newer' "$bundle/README.md" || fail "README.md does not name the glibc that it needs"
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
    "$build/bin/mandelbox" "$source/paramsBox.dat" $small --output b.exr || fail "no picture from the build"
    in_bundle imgdiff a.exr b.exr >/dev/null || fail "other bits than the build's"
    in_bundle bench --backend openmp --fractal box --precision float --size 32x24 --repetitions 2 --runs 2 --json bench.json \
        >/dev/null 2>stderr || fail "bench: $(cat stderr)"
    in_bundle demo --side 16 >/dev/null 2>&1 || fail "demo"
    # If there is no ffmpeg, one line on stderr says so.
    env -i PATH=/nowhere "$bundle/bin/flythrough" film --frames 30 --size 64x36 --output film.mp4 2>stderr
    [ $? = 1 ] && [ "$(grep -c ffmpeg stderr)" = 1 ] || fail "without ffmpeg: $(cat stderr)"

    # Negative control: if one of the bundle's libraries is removed, the programs must not find it. This shows that they
    # do not use the machine's library.
    mv "$bundle/lib/libOpenEXR"* .
    [ -n "$(outside)" ] || fail "a library that is away is not missed"
}
