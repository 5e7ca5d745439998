// SPDX-License-Identifier: Apache-2.0
// A backend to copy, as small as one can be: the kernel text as scalar C++ on one thread. docs/add-a-backend.md.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_skeleton_backend();

}  // namespace mandelmarch
