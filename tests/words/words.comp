// SPDX-License-Identifier: Apache-2.0
// The words in GLSL: an invocation computes all words of a pair of operands.
#version 460
#include "core/kernel/prelude/glsl.h"
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "tests/words/words.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer First { real first[]; };
layout(std430, binding = 1) readonly buffer Second { real second[]; };
layout(std430, binding = 2) writeonly buffer Answers { real answers[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    uint pairs = first.length();
    uint words = answers.length() / pairs;
    for (uint word = 0; word < words; ++word) answers[word * pairs + i] = result_of(int(word), first[i], second[i]);
}
