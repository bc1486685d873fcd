// SPDX-License-Identifier: Apache-2.0
// What the page says once: objects, counts, losses, starts. Instances and messages are in the columns.
#pragma once

#include <string>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

// JSON that may stand in an HTML element `script`. Times count from the timeline's begin.
std::string page_facts(const TracedSystem& system);

}  // namespace tracing
