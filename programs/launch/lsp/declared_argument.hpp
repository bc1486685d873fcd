// SPDX-License-Identifier: Apache-2.0
// An argument as the text of a launch file declares it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace launch::lsp {

struct DeclaredArgument {
  std::string name;
  std::string description;
  std::optional<std::string> default_value;  // as it is written
  std::vector<std::string> choices;
};

}  // namespace launch::lsp
