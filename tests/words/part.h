// SPDX-License-Identifier: Apache-2.0
// The words by one of the preludes in C++. Has no include guard, because words_test.cpp includes it after each of them.
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "tests/words/words.h"
#include "core/kernel/prelude/undefine.h"
