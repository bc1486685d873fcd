// SPDX-License-Identifier: Apache-2.0
// Compares launch files of different formats by what they mean.
#pragma once

#include "launcher/frontend/entity.hpp"

namespace launch {

// True when both trees mean the same: names, order of children, attribute texts. A YAML scalar equals the XML text
// that is coerced to it; attribute order, places and the order between structured items of different names don't count.
bool equivalent(const Entity& left, const Entity& right);

}  // namespace launch
