// SPDX-License-Identifier: Apache-2.0
// The `if` and `unless` of an action.
#pragma once

#include <optional>

#include "launcher/substitution/substitution.hpp"

namespace launch {

class Condition {
 public:
  Condition() = default;  // always holds
  Condition(Template expression, bool negated) : expression_(std::move(expression)), negated_(negated) {}

  bool is_given() const { return expression_.has_value(); }

  // Throws LaunchError when the performed text is not true, 1, false or 0 (in any case).
  bool holds(Scope& scope) const;

 private:
  std::optional<Template> expression_;
  bool negated_ = false;
};

}  // namespace launch
