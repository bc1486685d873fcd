// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/action.hpp"

#include "launcher/visit/launch_context.hpp"

namespace launch {

void Action::visit(LaunchContext& context) const {
  if (condition_.holds(context.scope())) {
    execute(context);
  } else {
    context.visit_left_out([&] { execute(context); });
  }
}

}  // namespace launch
