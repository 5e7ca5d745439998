// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    return mandelmarch::fuzz_picture(mandelmarch::decode_pnm, data, size);
}
