// SPDX-License-Identifier: Apache-2.0
// Adds to the scalar prelude what CUDA needs. FN declares functions that run on the device. hide() makes the compiler
// assume that a value has changed.
#pragma once

#define FN static __device__ __forceinline__

namespace {

FN void hide(int& value) { asm volatile("" : "+r"(value)); }
template <class T>
FN void hide(T*& value)
{
    asm volatile("" : "+l"(value));
}

}  // namespace
#define MM_ANEW(value) hide(value)
