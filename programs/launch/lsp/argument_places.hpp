// SPDX-License-Identifier: Apache-2.0
// Where the arguments and configurations of a launch file stand in its text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

struct ArgumentPlace {
  enum class Kind {
    kDeclared,  // <arg name="…">, <let name="…">
    kRead,      // $(var …)
    kGiven      // <arg name="…"> of an include: an argument of the other file
  };

  Kind kind;
  std::string name;
  Span span;         // of the name
  int include = -1;  // number of the element `include`, of what is given
};

std::vector<ArgumentPlace> argument_places(const Outline& outline, std::string_view text);

}  // namespace launch::lsp
