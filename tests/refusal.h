// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/text/error.h"

namespace mandelmarch {

// Returns the message of the Exception that `call` throws; "" if it throws none.
template <class Exception, class Call>
std::string message_of(const Call& call)
{
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    return "";
}

template <class Call>
std::string refusal_of(const Call& call)
{
    return message_of<InputError>(call);
}

}  // namespace mandelmarch
