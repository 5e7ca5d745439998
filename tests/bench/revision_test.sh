#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# revision_test.sh CMAKE SOURCE: changed sources and sources of an unknown revision mark a build as dirty; new results
# do not.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*" >&2; exit 1; }
git init -q
mkdir -p results bench
echo a >results/bench.json
echo a >bench/source.cpp
git add .
git -c user.name=test -c user.email=test@test commit -qm one
# dirty CMAKE SOURCE EXPECTED WHAT: generates the header and checks that MANDELMARCH_DIRTY is EXPECTED in it. WHAT is
# printed on failure.
dirty() {
    "$1" -DSOURCE="${sources:-$work}" -DOUTPUT="$work/out/revision.h" -P "$2/cmake/Revision.cmake"
    grep -q "MANDELMARCH_DIRTY $3" out/revision.h || fail "$4: $(cat out/revision.h)"
}
dirty "$1" "$2" false "as committed"
grep -q "$(git rev-parse HEAD)" out/revision.h || fail "not git's revision"
echo b >results/bench.json
dirty "$1" "$2" false "a result measured again"
echo b >bench/source.cpp
dirty "$1" "$2" true "a changed source"
git checkout -q bench
if [ "$(id -u)" = 0 ]; then
    chown -R 1 .git
    GIT_CEILING_DIRECTORIES=$work dirty "$1" "$2" false "sources of another user"
    ln -s . link
    sources=$work/link dirty "$1" "$2" false "sources of another user, through a link"
    rm link
    chown -R 0 .git
fi
mkdir inner
sources=$work/inner dirty "$1" "$2" true "sources in another repository"
rm -rf .git
dirty "$1" "$2" true "sources without a repository"
