// SPDX-License-Identifier: Apache-2.0
// The sections of the text report. Each one begins with an empty line, and is empty when it has nothing to say.
#pragma once

#include <string>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

// Those that are always shown: tables that fit a screen.
std::string chain_table(const TraceResults& results, const ReportOptions& options);
std::string callback_table(const TraceResults& results, const ReportOptions& options);
std::string topic_table(const Ros2Results& ros2, const ReportOptions& options);
std::string executor_table(const TraceResults& results, const ReportOptions& options);
std::string service_table(const TraceResults& results, const ReportOptions& options);
std::string action_table(const TraceResults& results, const ReportOptions& options);
std::string lifecycle_table(const TraceResults& results, const ReportOptions& options);

// What the launcher saw and did while the system ran, in the order of time, which counts from `zero_ns`.
std::string launcher_section(const std::vector<LauncherEventResult>& all, std::int64_t zero_ns,
                             const ReportOptions& options);

// Whether the options leave the chain in the report.
bool is_chosen(const ChainResult& chain, const ReportOptions& options);

// Those that are shown on demand. Losses by stream, events by process.
std::string event_details(const Report& report);

// Topics, the ways of their messages, chains, service calls, and what executors served.
std::string message_details(const TraceResults& results);

// event_details(), message_details(), and every start, callback, lifecycle state and unmatched event.
std::string details(const Report& report);

// The steps of one chain with their times.
std::string chain_details(const ChainResult& chain, const Hosts& hosts);

// What limits the results.
std::string notes(const Report& report);

}  // namespace tracing
