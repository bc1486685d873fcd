// SPDX-License-Identifier: Apache-2.0
// The tables of the text report. Each one begins with an empty line, and is empty when no row is left.
#pragma once

#include <string>

#include "tracing/show/report/report.hpp"

namespace tracing {

// Whether the options leave the chain in the report.
bool is_chosen(const ChainResult& chain, const ReportOptions& options);

std::string chain_table(const TraceResults& results, const ReportOptions& options);
std::string callback_table(const TraceResults& results, const ReportOptions& options);
std::string topic_table(const Ros2Results& ros2, const ReportOptions& options);
std::string executor_table(const TraceResults& results, const ReportOptions& options);
std::string service_table(const TraceResults& results, const ReportOptions& options);
std::string action_table(const TraceResults& results, const ReportOptions& options);
std::string lifecycle_table(const TraceResults& results, const ReportOptions& options);

}  // namespace tracing
