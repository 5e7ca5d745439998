#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# consumer.sh BUILD: installs the build into an empty folder, and builds and runs a program with the installed package,
# by CMake and, after the folder has moved, by pkg-config. The installed programs start, also in a folder whose path has
# a blank.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/prefix" >/dev/null
cmake -S consumer -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$folder/build"
"$folder/build/consumer"
mv "$folder/prefix" "$folder/moved"
flags=$(PKG_CONFIG_PATH=$(dirname "$folder"/moved/lib*/pkgconfig/mandelmarch.pc) pkg-config --cflags --libs mandelmarch)
c++ consumer/main.cpp $flags -o "$folder/by-pkg-config"
"$folder/by-pkg-config"
DESTDIR="$folder/a b" cmake --install "$1" --prefix /usr >/dev/null
for program in mandelbulb mandelbox render imgdiff demo flythrough bench; do
    "$folder/a b/usr/bin/$program" --version
done
"$folder/a b/usr/bin/mandelbulb" "$folder/a b/usr/share/mandelmarch/paramsBulb.dat" --size 32x32 --backend openmp --output "$folder/bulb.png"
[ -s "$folder/a b/usr/share/doc/mandelmarch/LICENSE" ]
[ -s "$folder/a b/usr/share/mandelmarch/schemas/result.schema.json" ]
if command -v help2man >/dev/null; then grep -q '^\.B render' "$folder/a b/usr/share/man/man1/render.1"; fi
