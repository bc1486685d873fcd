// SPDX-License-Identifier: Apache-2.0
// Names a part of a message or of an event: "pose.pose.position", "covariance[3]".
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

struct FieldPath {
  struct Part {
    std::variant<std::string, std::size_t> step;  // the name of a field, or the number of an element
    std::size_t begin = 0;                        // its bytes in the text, with the brackets
    std::size_t end = 0;
  };
  std::vector<Part> parts;  // none: the whole

  // Reads a whole text. Points separate names, and more of them than needed have no effect, as in `ros2`. Throws
  // LaunchError at the place of a mistake.
  static FieldPath parse(const LocatedText& text);
  // Reads a path at the byte `at` of a text, and moves `at` behind it. There may be blanks around points.
  static FieldPath take(const LocatedText& text, std::size_t& at);
};

}  // namespace launch
