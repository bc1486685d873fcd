// SPDX-License-Identifier: Apache-2.0
// Compares the meaning of launch files of different formats.
#pragma once

#include "launcher/frontend/entity.hpp"

namespace launch {

// True if both trees have the same meaning: equal names, attributes and children in equal order. A YAML scalar equals
// an XML text that is coerced to its value. The order of attributes, the places in the files, and the order between
// structured items of different names do not count.
bool equivalent(const Entity& left, const Entity& right);

}  // namespace launch
