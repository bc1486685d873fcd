// SPDX-License-Identifier: Apache-2.0
// The keys of the report's JSON, in their order, with what stands behind them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tracing/model/findings/finding.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

// Calls visit(key, value) for each key. docs/report_format.md says what they mean.
template <class Visit>
void visit_report(const Report& report, Visit& visit) {
  const auto& [overview, starts, startup, launcher_events, ros2, warnings] = report.results;
  std::vector<std::string> open;
  for (const std::filesystem::path& directory : report.open) {
    open.push_back(directory.native());
  }
  visit("version", std::int64_t{1});
  visit("directory", report.directory.native());
  visit("error", report.error.empty() ? std::nullopt : std::optional(report.error));
  visit("begin_ns", overview.begin_ns);
  visit("end_ns", overview.end_ns);
  visit("events", overview.events);
  visit("processes", overview.processes);
  visit("others", report.others);
  visit("starts", starts);
  visit("startup", startup);
  visit("launcher_events", launcher_events);
  visit("cost", report.verdict);
  visit("losses", overview.losses);
  visit("absent", report.verdict.absences);
  visit("overwritten", report.verdict.overwritten);
  visit("open", open);
  visit("clocks", report.clocks);
  visit("event_counts", overview.event_counts);
  visit("findings", find_worth_a_look(report.results));
  visit("callbacks", ros2.callbacks);
  visit("topics", ros2.topics);
  visit("calls", ros2.calls);
  visit("actions", ros2.actions);
  visit("nodes", ros2.nodes);
  visit("executions", ros2.executions);
  visit("subscriptions", ros2.subscriptions);
  visit("executors", ros2.executors);
  visit("chains", ros2.chains);
  visit("lifecycle", ros2.lifecycle);
  visit("unmatched", ros2.unmatched);
  visit("unseen_chains", ros2.unseen_chains);
  visit("has_all_chains", ros2.has_all_chains);
  visit("internal_messages", ros2.internal_messages);
  visit("unknown_messages", ros2.unknown_messages);
  visit("tracetools", ros2.tracetools);
  visit("remarks", ros2.remarks);
  visit("lacks_thread_context", ros2.lacks_thread_context);
  visit("warnings", warnings);
}

}  // namespace tracing
