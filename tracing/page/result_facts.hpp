// SPDX-License-Identifier: Apache-2.0
// Results of the whole trace that the page shows as they are.
#pragma once

#include "tracing/page/page_json.hpp"
#include "tracing/timeline/traced_system.hpp"

namespace tracing {

// starts, startup, calls, actions, state_memory, callback_memory, cost, absences, overwritten. Times count from the
// timeline's begin.
PageJson result_facts(const TracedSystem& system);

}  // namespace tracing
