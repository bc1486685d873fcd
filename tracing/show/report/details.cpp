// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/details.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "tracing/model/findings/printable.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

std::string cost_section(const Report& report) {
  if (report.verdict.processes.empty()) {
    return "";
  }
  const TextTable table(36, {12, 12, 16, 18});
  std::string text = "\n" + table.row("Cost of tracing", {"events", "time", "of a processor", "for each callback"});
  for (const RecordedVerdict::ProcessCost& process : report.verdict.processes) {
    text += table.row(fmt::format("  {} [{}]", process.name, process.vpid),
                      {fmt::format("{}", process.events), format_duration(process.seconds * 1e9),
                       fmt::format("{:.2g} %", 100 * process.processor_share),
                       process.ns_per_callback ? format_duration(*process.ns_per_callback) : "-"});
  }
  return text + "  (estimated when the trace was recorded: events times the cost of one)\n";
}

std::string node_section(const TraceResults& results) {
  if (results.ros2.nodes.empty()) {
    return "";
  }
  std::map<ProcessIndex, std::size_t> nodes_of_process;
  for (const NodeResult& node : results.ros2.nodes) {
    ++nodes_of_process[node.process];
  }
  const Hosts hosts(results.overview);
  const TextTable table(56, {12, 14});
  std::string text = "\n" + table.row("Nodes", {"callbacks", "in callbacks"});
  for (const NodeResult& node : results.ros2.nodes) {
    std::string label = "  " + hosts.before(node.process) + node.name;
    if (node.process < results.overview.processes.size()) {
      label += ", " + process_label(results.overview.processes[node.process]);
    }
    if (const std::size_t others = nodes_of_process[node.process] - 1; others > 0) {
      label += fmt::format(" with {}", format_count(others, "other node"));
    }
    text +=
        table.row(label, {fmt::format("{}", node.callbacks), format_duration(static_cast<double>(node.callback_ns))});
  }
  return text;
}

std::string callback_section(const TraceResults& results) {
  if (results.ros2.callbacks.empty()) {
    return "";
  }
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Callbacks", duration_titles());
  std::string last_node;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    const std::string node = node_label(callback.node, callback.process, results.overview);
    if (node != last_node) {
      text += fmt::format("{}\n", node);
    }
    last_node = node;
    text += table.row("  " + source_label(callback), duration_cells(callback.durations));
    if (!callback.symbol.empty()) {
      text += fmt::format("    {}\n", callback.symbol);
    }
    if (callback.intra_process > 0) {
      text += fmt::format("    {} of them intra-process\n", callback.intra_process);
    }
    if (callback.running.count > 0) {
      text += table.row("    running", duration_cells(callback.running));
      text += table.row("    waiting for a processor", duration_cells(callback.runnable));
      text += table.row("    blocked", duration_cells(callback.blocked));
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
  }
  return text;
}

std::string lifecycle_section(const TraceResults& results) {
  if (results.ros2.lifecycle.empty()) {
    return "";
  }
  const TextTable table(36, {16, 16, 16});
  std::string text = "\n" + table.row("Lifecycle", {"from", "to", "duration"});
  std::string last_node;
  const auto since_begin = [&](std::int64_t time_ns) {
    return fmt::format("{:+.3f} s", static_cast<double>(time_ns - results.overview.begin_ns.value_or(0)) / 1e9);
  };
  for (const LifecycleResult& state : results.ros2.lifecycle) {
    const std::string node = node_label(state.node, state.process, results.overview);
    if (node != last_node) {
      text += fmt::format("{}\n", node);
    }
    last_node = node;
    text += table.row("  " + state.state,
                      {since_begin(state.begin_ns), state.ended ? since_begin(state.end_ns) : "end of trace",
                       format_duration(static_cast<double>(state.end_ns - state.begin_ns))});
    if (state.process_allocations > 0) {
      text += fmt::format("    asked {} times for memory in callbacks, {} bytes; its process {} times, {} bytes\n",
                          *state.allocations, state.allocated_bytes, state.process_allocations,
                          state.process_allocated_bytes);
    }
  }
  return text;
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
  if (ros2.unknown_messages > 0) {
    note(fmt::format("{} of publishers or subscriptions whose creation is not in the trace: was it started late?",
                     format_count(ros2.unknown_messages, "message")));
  }
  for (const std::string& warning : results.warnings) {
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
