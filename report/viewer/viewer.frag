// SPDX-License-Identifier: Apache-2.0
// The kernel text as a fragment shader: the report's viewer draws with it, in float. glslang makes SPIR-V of it and
// spirv-cross the GLSL ES 3.00 that browsers read.
#version 460
#define MM_REAL_IS_FLOAT 1
#define MM_PINNED 0
#include "core/kernel/prelude/glsl.h"
#include "core/kernel/text.h"

layout(std140, binding = 0) uniform SceneBlock { Scene whole_scene; };

// 1: instead of a pixel, the bits of the distance estimate at the eye, the camera's speed, lowest byte first.
layout(std140, binding = 1) uniform PassBlock { int probing; };

layout(location = 0) out vec4 result;

void main()
{
    if (probing != 0) {
        uint bits = floatBitsToUint(estimate(whole_scene, whole_scene.eye, true).distance);
        result = vec4(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u, bits >> 24) / 255.0;
        return;
    }
    Pixel done = draw(whole_scene, floor(gl_FragCoord.x), floor(gl_FragCoord.y));
    // As core/image/image.cpp cuts a colour to a byte: trunc(255 c). The buffer's own rounding is to nearest.
    result = vec4(floor(done.colour * 255.0) / 255.0, 1.0);
}
