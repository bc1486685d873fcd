// SPDX-License-Identifier: Apache-2.0
// Names of sessions with a time stamp, which launches that start in the same second would share.
#pragma once

#include "base/files/unique_fd.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// Appends -2, -3, … to the name of the session until its directory does not exist and no other run has claimed it. The
// claim lasts as long as the descriptor, and ends with the process. Launches with a network of their own do not see it.
// Does nothing for a session whose name has no time stamp, or that is added to a trace.
launch::UniqueFd claim_free_name(TraceConfig& config);

}  // namespace tracing
