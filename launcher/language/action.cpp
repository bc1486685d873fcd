// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/action.hpp"

#include <fmt/format.h>

#include "launcher/substitution/boolean.hpp"

namespace launch {

bool Condition::holds(Scope& scope) const {
  if (!expression_) {
    return true;
  }
  const std::string text = expression_->perform(scope);
  const std::optional<bool> value = condition_boolean(text);
  if (!value) {
    throw LaunchError(
        fmt::format("invalid condition expression, expected one of [true, 1, false, 0] but got '{}'", text),
        expression_->where(), "yes, on and the like are no conditions; an expression: $(eval '...')");
  }
  return *value != negated_;
}

}  // namespace launch
