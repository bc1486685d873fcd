// SPDX-License-Identifier: Apache-2.0
#include "launcher/core/action.hpp"

#include "launcher/core/launch_context.hpp"

namespace launch {

void Action::visit(LaunchContext& context) const {
  if (condition_.holds(context.scope())) {
    execute(context);
  } else {
    context.visit_left_out([&] { execute(context); });
  }
}

}  // namespace launch
