// SPDX-License-Identifier: Apache-2.0
// The attribute max-overhead of <trace>: watches what recording costs, and puts every cut into the trace itself.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "launcher/language/fields.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/account/overhead_guard.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace launch {

// Reads "2%" as 0.02. Throws LaunchError.
double perform_percentage(const Template& text, Scope& scope);

// Throws LaunchError for an entry that is neither a class of events nor a pattern with its provider.
void check_drop_order(const std::vector<std::string>& order, const SourceRange& where);

// Watches a session that records. Measures the cost of an event if it is not known yet. Calls `tell` on the loop's
// thread. Throws tracing::TraceError.
std::unique_ptr<tracing::OverheadGuard> watch_overhead(const tracing::TraceConfig& config, const std::string& prefix,
                                                       EventLoop& loop, const RunScope::Tell& tell);

}  // namespace launch
