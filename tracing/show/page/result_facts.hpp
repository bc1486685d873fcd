// SPDX-License-Identifier: Apache-2.0
// Results of the whole trace that the page shows as they are.
#pragma once

#include "tracing/model/timeline/traced_system.hpp"
#include "tracing/show/page/page_json.hpp"

namespace tracing {

// starts, startup, calls, actions, state_memory, callback_memory, cost, absences, overwritten. Times count from the
// timeline's begin.
PageJson result_facts(const TracedSystem& system);

}  // namespace tracing
