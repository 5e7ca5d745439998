// SPDX-License-Identifier: Apache-2.0
// A minimal backend to copy: the kernel as scalar C++ on one thread. See docs/add-a-backend.md.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_skeleton_backend();

}  // namespace mandelmarch
