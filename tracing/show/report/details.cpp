// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "tracing/model/findings/printable.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

std::string cost_section(const Report& report) {
  using Cost = RecordedVerdict::ProcessCost;
  const Section<Cost> section{
      .title = "Cost of tracing",
      .label_width = 36,
      .columns = {{"events", 12, number_of(&Cost::events)},
                  {"time", 12, [](const Cost& cost) { return format_duration(cost.seconds * 1e9); }},
                  {"of a processor", 16,
                   [](const Cost& cost) { return fmt::format("{:.2g} %", 100 * cost.processor_share); }},
                  {"for each callback", 18,
                   [](const Cost& cost) {
                     return cost.ns_per_callback ? format_duration(*cost.ns_per_callback) : "-";
                   }}},
      .label = [](const Cost& cost) { return fmt::format("  {} [{}]", cost.name, cost.vpid); },
      .end = "  (estimated when the trace was recorded: events times the cost of one)\n"};
  return section.text(report.verdict.processes);
}

std::string node_section(const TraceResults& results) {
  std::map<ProcessIndex, std::size_t> nodes_of_process;
  for (const NodeResult& node : results.ros2.nodes) {
    ++nodes_of_process[node.process];
  }
  const Hosts hosts(results.overview);
  const auto label = [&](const NodeResult& node) {
    std::string text = "  " + hosts.before(node.process) + node.name;
    if (node.process < results.overview.processes.size()) {
      text += ", " + process_label(results.overview.processes[node.process]);
    }
    const std::size_t others = nodes_of_process[node.process] - 1;
    return others > 0 ? text + fmt::format(" with {}", format_count(others, "other node")) : text;
  };
  const Section<NodeResult> section{.title = "Nodes",
                                    .label_width = 56,
                                    .columns = {{"callbacks", 12, number_of(&NodeResult::callbacks)},
                                                {"in callbacks", 14, time_of(&NodeResult::callback_ns)}},
                                    .label = label};
  return section.text(results.ros2.nodes);
}

// The node that a result belongs to, as a line above it.
template <class Result>
auto node_of(const TraceOverview& overview) {
  return [&overview](const Result& result) { return node_label(result.node, result.process, overview); };
}

std::string more_of_callback(const CallbackResult& callback) {
  std::string text;
  if (!callback.symbol.empty()) {
    text += fmt::format("    {}\n", callback.symbol);
  }
  if (callback.intra_process > 0) {
    text += fmt::format("    {} of them intra-process\n", callback.intra_process);
  }
  if (callback.running.count > 0) {
    text += duration_row("    running", callback.running) +
            duration_row("    waiting for a processor", callback.runnable) +
            duration_row("    blocked", callback.blocked);
  }
  if (callback.allocated_bytes > 0) {
    text += fmt::format("    asked {} times for memory, {} bytes\n", *callback.allocations, callback.allocated_bytes);
  }
  if (callback.overruns > 0) {
    text += fmt::format("    {} took longer than the period\n", format_count(callback.overruns, "run"));
  }
  if (callback.unfinished > 0) {
    text += fmt::format("    {} more without an end\n", callback.unfinished);
  }
  return text;
}

std::string callback_section(const TraceResults& results) {
  const Section<CallbackResult> section{
      .title = "Callbacks",
      .label_width = kDurationLabel,
      .columns = duration_columns(&CallbackResult::durations),
      .label = [](const CallbackResult& callback) { return "  " + source_label(callback); },
      .group = node_of<CallbackResult>(results.overview),
      .more = more_of_callback};
  return section.text(results.ros2.callbacks);
}

std::string lifecycle_section(const TraceResults& results) {
  const auto since_begin = [&](std::int64_t time_ns) {
    return fmt::format("{:+.3f} s", static_cast<double>(time_ns - results.overview.begin_ns.value_or(0)) / 1e9);
  };
  const auto memory = [](const LifecycleResult& state) {
    return state.process_allocations == 0
               ? ""
               : fmt::format("    asked {} times for memory in callbacks, {} bytes; its process {} times, {} bytes\n",
                             *state.allocations, state.allocated_bytes, state.process_allocations,
                             state.process_allocated_bytes);
  };
  const Section<LifecycleResult> section{
      .title = "Lifecycle",
      .label_width = 36,
      .columns = {{"from", 16, [&](const LifecycleResult& state) { return since_begin(state.begin_ns); }},
                  {"to", 16,
                   [&](const LifecycleResult& state) {
                     return state.ended ? since_begin(state.end_ns) : "end of trace";
                   }},
                  {"duration", 16,
                   [](const LifecycleResult& state) { return time_text(state.end_ns - state.begin_ns); }}},
      .label = [](const LifecycleResult& state) { return "  " + state.state; },
      .group = node_of<LifecycleResult>(results.overview),
      .more = memory};
  return section.text(results.ros2.lifecycle);
}

std::string start_section(const std::vector<StartResult>& starts) {
  const auto spawn = [](const StartResult& start) {
    return time_text(start.spawn_ns ? std::optional(start.exec_ns - *start.spawn_ns) : std::nullopt);
  };
  const Section<StartResult> section{
      .title = "Start of processes",
      .label_width = 36,
      .columns = {{"spawn", 10, spawn},
                  {"rcl_init", 10, time_of(&StartResult::init_after_ns)},
                  {"first node", 12, time_of(&StartResult::node_after_ns)},
                  {"ready", 10, time_of(&StartResult::ready_after_ns)},
                  {"callback", 12, time_of(&StartResult::callback_after_ns)},
                  {"message", 12, time_of(&StartResult::publication_after_ns)}},
      .label = [](const StartResult& start) { return fmt::format("  {} [{}]", start.process, start.vpid); },
      .end =
          "  (spawn: until exec; all others after exec: ready, an executor looks for work; the first callback; the "
          "first\n"
          "  message that it publishes)\n"};
  return section.text(starts);
}

std::string path_section(const StartupResult& startup) {
  const Section<StartStep> section{
      .title = "Critical path of the start, " + time_text(startup.ready_ns - startup.begin_ns),
      .label_width = 72,
      .columns = {{"from", 14, [&](const StartStep& step) { return time_text(step.begin_ns - startup.begin_ns); }},
                  {"took", 14, [](const StartStep& step) { return time_text(step.end_ns - step.begin_ns); }}},
      .label = [](const StartStep& step) {
        return fmt::format("  {}: {}", step.process.empty() ? "launcher" : step.process, step.what);
      }};
  return section.text(startup.critical_path);
}

std::string start_details(const TraceResults& results) {
  return start_section(results.starts) +
         (!results.starts.empty() && results.startup ? path_section(*results.startup) : "");
}

std::string unmatched_section(const Ros2Results& ros2) {
  if (ros2.unmatched.empty()) {
    return "";
  }
  std::string text = "\nEvents without the event that belongs to them\n";
  for (const UnmatchedResult& unmatched : ros2.unmatched) {
    text += fmt::format("{:>10} {}: {}\n", unmatched.count, unmatched.event, unmatched.reason);
  }
  return text;
}

}  // namespace

std::string notes(const Report& report) {
  std::string text;
  const auto note = [&text](const std::string& sentence) { text += fmt::format("  {}\n", sentence); };
  const TraceResults& results = report.results;
  const Ros2Results& ros2 = results.ros2;
  if (report.lacks_descriptions) {
    note(
        "Events that LTTng has not described yet are left out; it describes them when a traced program ends or the "
        "session is stopped.");
  }
  if (!report.sessions.empty()) {
    note(
        fmt::format("{} sessions of one machine are read as one, from the first event to the last: {}. Loads count the "
                    "time between them, too.",
                    report.sessions.size(), printable(fmt::format("{}", fmt::join(report.sessions, ", ")))));
  }
  for (const std::string& clock : report.clocks) {
    note(fmt::format("{}{}.", static_cast<char>(std::toupper(clock.front())), printable(clock.substr(1))));
  }
  const auto has_event = [&results](std::string_view begin) {
    const auto fits = [begin](const EventCount& count) { return count.name.starts_with(begin); };
    return std::any_of(results.overview.event_counts.begin(), results.overview.event_counts.end(), fits);
  };
  if (!results.overview.event_counts.empty() && !has_event("ros2:")) {
    note("The trace has no events of ROS 2, so nothing is known about nodes, callbacks and messages.");
  } else if (has_event("ros2:") && ros2.nodes.empty() && (!ros2.callbacks.empty() || ros2.unknown_messages > 0)) {
    note(
        "The trace has no rcl_node_init: callbacks and messages have no nodes. Were these events recorded, and did the "
        "session begin before the nodes?");
  }
  for (const TopicResult& topic : ros2.topics) {
    if (topic.early == 0) {
      continue;
    }
    note(fmt::format(
        "{} of {} were taken up to {} before they were published: the clocks of two machines differ, and times between "
        "them are wrong.",
        format_count(topic.early, "message"), topic.name, format_duration(static_cast<double>(topic.earliest_ns))));
  }
  if (ros2.lacks_thread_context) {
    note("The session had no context vpid or vtid: processes and threads can't be told apart.");
  }
  if (const std::uint64_t late = ros2.unknown_messages - ros2.unknown_in_whole; late > 0) {
    note(fmt::format("{} of publishers or subscriptions whose creation is not in the trace: was it started late?",
                     format_count(late, "message")));
  }
  if (ros2.unknown_in_whole > 0) {
    note(fmt::format(
        "{} of publishers or subscriptions whose creation is not in the trace, although it has the begin of their "
        "processes: were these events recorded, or lost?",
        format_count(ros2.unknown_in_whole, "message")));
  }
  for (const std::string& remark : ros2.remarks) {
    note(remark);
  }
  for (const std::string& warning : results.warnings) {
    if (!ros2.remarks.empty() && warning.starts_with("ros2:rmw_publish has no field ")) {
      continue;  // a remark says what that means
    }
    note(fmt::format("{} (recorded by another version of ros2_tracing?)", warning));
  }
  return text.empty() ? "" : "\nNotes\n" + text;
}

std::string details(const Report& report) {
  return event_details(report) + start_details(report.results) + cost_section(report) + node_section(report.results) +
         callback_section(report.results) + message_details(report.results) + lifecycle_section(report.results) +
         unmatched_section(report.results.ros2);
}

}  // namespace tracing
