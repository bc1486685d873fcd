// SPDX-License-Identifier: Apache-2.0
// Keeps a session within its budget of overhead, and puts every cut into the trace itself.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tracing/record/account/overhead_guard.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// Watches a session that records. Measures the cost of an event if it is not known yet. `prefix` is the folder of
// lib/launch/liblaunch_trace.so, which fires the launcher's events. Calls `tell` from the guard's thread. Throws
// TraceError.
std::unique_ptr<OverheadGuard> watch_overhead(const TraceConfig& config, const std::string& prefix,
                                              const std::function<void(bool warning, const std::string& text)>& tell);

}  // namespace tracing
