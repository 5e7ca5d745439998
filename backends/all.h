// Every backend there is, built or not.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

Registry all_backends();

}  // namespace mandelmarch
