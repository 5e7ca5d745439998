#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# spdx_test.sh SOURCE: checks that every source in the git repository has its licence line. Exit code 77: SOURCE is not
# a git checkout.
cd "$1" && git rev-parse -q --git-dir >/dev/null || exit 77
lacking=$(git grep -IL 'SPDX-License-Identifier: Apache-2\.0' -- . ':!.*' ':!LICENSE' ':!results' ':!*packages.txt' \
    ':!*.cff' ':!*.dat' ':!*.json' ':!*.json.in' ':!*.md' ':!*.md.in' ':!*.sha256' ':!*.svg')
[ -z "$lacking" ] || { echo "no licence line in: $lacking"; exit 1; }
