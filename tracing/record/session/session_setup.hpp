// SPDX-License-Identifier: Apache-2.0
// The beginning of a session: checked, created, configured, started.
#pragma once

#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/tracer.hpp"

namespace tracing {

// What the directories of further recordings in the directory of a trace begin with.
inline constexpr const char* kAppended = "appended-";

// Starts the session daemon if none runs. A daemon whose consumer was killed is started again if a launch has started
// it and nobody has a session there. Throws TraceError with nothing left behind.
SetupReport start_session(const TraceConfig& config);

}  // namespace tracing
