# SPDX-License-Identifier: Apache-2.0
# Tests tests/cases.sh, which also runs this test. A good case passes, and each kind of failure fails its case.
cases=$(dirname "$script")/cases.sh

test_failures() {
    cat >made.sh <<'END'
test_good() { expect 0 true; expect 2 sh -c 'echo one line >&2; exit 2'; }
test_code() { expect 0 false; }
test_lines() { expect 2 sh -c 'echo two >&2; echo lines >&2; exit 2'; }
test_files() { expect 2 sh -c 'echo one line >&2; : >new; exit 2'; }
test_pattern() { expect 0 echo text; says text; }
test_background() { fail & wait; }
END
    local all="good code lines files pattern background" name
    CASES=$all bash "$cases" made.sh good || fail "a good case fails"
    for name in code lines files pattern background unknown; do
        CASES=$all bash "$cases" made.sh $name && fail "$name passes"
    done
    CASES="good code" bash "$cases" made.sh good && fail "a case that is not listed is not detected"
    [ -z "$(ls -A | grep -v made.sh)" ] || fail "something is left: $(ls -A)"
}
