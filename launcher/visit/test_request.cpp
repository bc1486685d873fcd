// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/test_request.hpp"

#include <fmt/format.h>

namespace launch {

std::string ExpectedLine::describe() const {
  if (text.empty()) {
    return pattern.describe();
  }
  std::string description = fmt::format("a line with '{}'", text);
  if (!pattern.expression().empty()) {
    description += fmt::format(" that matches '{}'", pattern.expression());
  }
  return pattern.stream() == "both" ? description : fmt::format("{} on {}", description, pattern.stream());
}

}  // namespace launch
