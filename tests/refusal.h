// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/text/error.h"

namespace mandelmarch {

// Returns the message of the InputError that `call` throws; "" if it throws none.
template <class Call>
std::string refusal_of(const Call& call)
{
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace mandelmarch
