# SPDX-License-Identifier: Apache-2.0
# Cases run by tests/cases.sh with SOURCE BUILD: another project (consumer/) uses mandelmarch as a subproject or as an
# installed package, and builds that cannot work are refused.
source=$1
build=$2

# has TEXT: expects that the log has the text.
has() { grep -q -- "$1" log || fail "no '$1': $(tail -5 log)"; }

# Mandelmarch as a subproject does not change the settings of its parent project, which chooses the backends. Negative
# control: a changed setting is detected.
test_subproject() {
    configure() { cmake -G Ninja -S "$source/tests/builds/consumer" -B "$1" -DMANDELMARCH_SOURCE="$source" "${@:2}" >log 2>&1; }
    configure plain || fail "the subproject: $(tail log)"
    configure changed -DCHANGED=ON && fail "a changed setting is not detected"
    has "the parent's settings have changed"
    configure few -DMANDELMARCH_BACKENDS=vulkan,stdpar || fail "two backends: $(tail log)"
    has "backend opencl: not built"
    grep -q "backend \(openmp\|vulkan\): not built" log && fail "a chosen backend is not built"
    configure nonsense -DMANDELMARCH_BACKENDS=vulkan,nonsense && fail "an unknown backend is not detected"
    has "MANDELMARCH_BACKENDS: 'nonsense' given, expected all or some of reference"
}

# A program is built with the installed package, by CMake and, after its folder has moved, by pkg-config. The installed
# programs start, also in a folder whose path has a blank.
test_package() {
    local flags program usr="a b/usr"
    set -e
    cmake --install "$build" --prefix "$PWD/prefix" >log
    cmake -S "$source/tests/builds/consumer" -B made -DCMAKE_PREFIX_PATH="$PWD/prefix" -DCMAKE_BUILD_TYPE=Release >log
    cmake --build made
    made/consumer
    mv prefix moved
    flags=$(PKG_CONFIG_PATH=$(dirname "$PWD"/moved/lib*/pkgconfig/mandelmarch.pc) pkg-config --cflags --libs mandelmarch)
    c++ "$source/tests/builds/consumer/main.cpp" $flags -o by-pkg-config
    ./by-pkg-config
    DESTDIR="$PWD/a b" cmake --install "$build" --prefix /usr >log
    for program in mandelbulb mandelbox render imgdiff demo flythrough bench; do "$usr/bin/$program" --version; done
    "$usr/bin/mandelbulb" "$usr/share/mandelmarch/paramsBulb.dat" --size 32x32 --backend openmp --output bulb.png
    [ -s "$usr/share/doc/mandelmarch/LICENSE" ]
    [ -s "$usr/share/mandelmarch/schemas/result.schema.json" ]
    ! command -v help2man >/dev/null || grep -q '^\.B render' "$usr/share/man/man1/render.1"
}

# In a build folder whose path contains a blank, the configuration gives the reason why OpenACC is left out.
test_blank() {
    local folder
    cat >CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(blank LANGUAGES CXX)
include($source/cmake/Nvptx.cmake)
mandelmarch_offloads(openacc -fopenacc "acc parallel loop copyout(sums)")
END
    for folder in ab "a b"; do
        cmake -S . -B "$folder" -DCMAKE_CXX_COMPILER=g++ >log
        ! grep -q "no offload compiler" log || exit 77
        [ "$folder" = "a b" ] || ! grep -q "contains a blank" log || fail "$folder: $(cat log)"
    done
    has "openacc: '.*/a b' contains a blank"
}

# The kernel source does not compile for 32-bit x86 with x87 arithmetic, which computes in a higher precision than the
# type's. With SSE2 arithmetic it does.
test_excess_precision() {
    [ "$(uname -m)" = x86_64 ] || exit 77
    compile() {
        g++ -std=c++20 -m32 "-I$source" "$@" -DMM_REAL=float -DMM_REAL_IS_FLOAT=1 -fsyntax-only -x c++ - \
            <<<'#include "core/kernel/prelude/scalar.h"' >log 2>&1
    }
    compile -msse2 -mfpmath=sse || fail "SSE2 arithmetic: $(head -5 log)"
    compile -mno-sse -mfpmath=387 && fail "x87 arithmetic compiles"
    has "higher precision than the type's"
}
