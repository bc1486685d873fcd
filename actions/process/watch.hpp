// SPDX-License-Identifier: Apache-2.0
// <watch …/> of a process: how it is told whether the process is healthy, and what follows when it is not.
#pragma once

#include "launcher/language/fields.hpp"
#include "launcher/process/health_watch.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class WatchItem {
 public:
  // The declaration for the ActionType of a process.
  static ItemSpec item();

  // Throws LaunchError for values that are wrong whatever a visit brings.
  static void check(const Fields& fields);
  // Adds the watch to the process if the condition of the item holds. Throws LaunchError.
  static void perform(const Fields& fields, LaunchContext& context, ProcessSpec& spec);
};

}  // namespace launch
