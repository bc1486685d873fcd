// SPDX-License-Identifier: Apache-2.0
// Whether two trees of launch files say the same, wherever it stands.
#pragma once

#include <string>

#include "launcher/frontend/entity.hpp"

namespace launch {

// Equal tags, attributes in any order, values with their types, children in order.
bool is_same_tree(const Entity& left, const Entity& right);

}  // namespace launch
