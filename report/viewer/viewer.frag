// SPDX-License-Identifier: Apache-2.0
// The kernel as a fragment shader in float, for the report's viewer. glslang compiles the shader to SPIR-V, and
// spirv-cross converts the SPIR-V to GLSL ES 3.00 for browsers.
#version 460
#define MM_REAL_IS_FLOAT 1
#define MM_PINNED 0
#include "core/kernel/prelude/glsl.h"
#include "core/kernel/text.h"

layout(std140, binding = 0) uniform SceneBlock { Scene whole_scene; };

// probing: if 1, the output is not a colour, but the bits of the distance estimate at the eye, lowest byte first. The
// viewer needs the estimate for the camera's speed.
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
    // Truncates a colour to a byte like core/image/image.cpp: trunc(255 c). Without this, the buffer rounds to nearest.
    result = vec4(floor(done.colour * 255.0) / 255.0, 1.0);
}
