// SPDX-License-Identifier: Apache-2.0
// The names in rules such as `-r rostopic://from:=to`.
#pragma once

#include <string_view>

namespace launch {

// The name without "rostopic://" or "rosservice://", which tell what a rule is for.
inline std::string_view without_scheme(std::string_view name) {
  for (const std::string_view scheme : {"rostopic://", "rosservice://"}) {
    if (name.starts_with(scheme)) {
      name.remove_prefix(scheme.size());
    }
  }
  return name;
}

}  // namespace launch
