// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/message.h"

namespace mandelmarch::isolation {

const char* Deserializer::advance(std::size_t size)
{
    if (size > bytes_.size() - at_) throw Error("a message of a device's process is too short");
    at_ += size;
    return bytes_.data() + at_ - size;
}

}  // namespace mandelmarch::isolation
