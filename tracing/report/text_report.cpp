// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tracing/report/report.hpp"
#include "tracing/report/text_table.hpp"

namespace tracing {

namespace {

std::string trace_section(const Report& report) {
  const TraceOverview& overview = report.results.overview;
  std::string text = fmt::format("Trace      {}\n", report.directory.string());
  if (!report.error.empty()) text += fmt::format("Damaged    {}\n", report.error);
  if (overview.begin_ns) {
    text += fmt::format("Recorded   {}, for {}\n", format_time(*overview.begin_ns),
                        format_duration(static_cast<double>(*overview.end_ns - *overview.begin_ns)));
  }
  text += fmt::format("Events     {} of {}\n", overview.events, format_count(overview.processes.size(), "process"));
  return text + fmt::format("Losses     {}\n", overview.losses.empty() ? "no events lost" : loss_phrase(overview));
}

// Paths below the trace's directory are shown relative to it.
std::string stream_label(const std::string& stream, const std::filesystem::path& directory) {
  const std::string below = std::filesystem::path(stream).lexically_relative(directory);
  return below.empty() || below.starts_with("..") ? stream : below;
}

std::string loss_section(const Report& report) {
  const TraceOverview& overview = report.results.overview;
  if (overview.losses.empty()) return "";
  const TextTable table(56, {10, 10, 12, 12});
  std::string text = "\n" + table.row("Losses by stream", {"events", "packets", "from", "to"});
  const auto since_begin = [&](const std::optional<std::int64_t>& time) -> std::string {
    if (!time || !overview.begin_ns) return "?";
    return fmt::format("{:+.3f} s", static_cast<double>(*time - *overview.begin_ns) / 1e9);
  };
  for (const LossResult& loss : overview.losses) {
    const bool nothing_counted = loss.events == 0 && loss.packets == 0;
    text += table.row("  " + stream_label(loss.stream, report.directory),
                      {nothing_counted ? "some" : fmt::format("{}{}", loss.events, loss.uncounted ? "+" : ""),
                       fmt::format("{}", loss.packets), since_begin(loss.begin_ns), since_begin(loss.end_ns)});
  }
  std::string doubtful;
  for (const ProcessResult& process : overview.processes) {
    if (process.doubtful) doubtful += (doubtful.empty() ? "" : ", ") + process_label(process);
  }
  return text + fmt::format("  What follows may be incomplete for: {}\n", doubtful.empty() ? "all" : doubtful);
}

// A column of the table of events: a process, or all processes that only the kernel's events show.
struct EventColumn {
  std::string title;
  std::vector<std::size_t> processes;
};

// A trace with events of the kernel has every process of the machine.
std::vector<EventColumn> event_columns(const TraceOverview& overview) {
  std::vector<EventColumn> columns;
  EventColumn others;
  for (std::size_t process = 0; process < overview.processes.size(); ++process) {
    const bool has_events_of_its_own =
        std::any_of(overview.event_counts.begin(), overview.event_counts.end(), [process](const EventCount& count) {
          return count.name.find(':') != std::string::npos && count.by_process[process] > 0;
        });
    if (has_events_of_its_own || overview.event_counts.empty()) {
      columns.push_back({process_label(overview.processes[process]), {process}});
    } else {
      others.processes.push_back(process);
    }
  }
  others.title = fmt::format("{} of the kernel alone", others.processes.size());
  if (!others.processes.empty()) columns.push_back(std::move(others));
  return columns;
}

// A table has as many columns as fit; the next columns follow in another table below.
std::string event_section(const TraceOverview& overview) {
  constexpr std::size_t kLabel = 42;
  constexpr std::size_t kTotal = 10;
  const std::vector<EventColumn> columns = event_columns(overview);
  std::string text;
  std::size_t first = 0;
  while (first < columns.size()) {
    std::vector<std::size_t> widths{kTotal};
    std::vector<std::string> titles{"total"};
    std::size_t used = kLabel + kTotal;
    std::size_t end = first;
    for (; end < columns.size(); ++end) {
      const std::size_t width = std::max<std::size_t>(columns[end].title.size() + 2, 10);
      if (end > first && used + width > kReportWidth) break;
      titles.push_back(columns[end].title);
      widths.push_back(width);
      used += width;
    }
    const TextTable table(kLabel, widths);
    text += "\n" + table.row("Events by process", titles);
    for (const EventCount& count : overview.event_counts) {
      std::vector<std::string> cells{fmt::format("{}", count.total)};
      for (std::size_t column = first; column < end; ++column) {
        std::uint64_t events = 0;
        for (const std::size_t process : columns[column].processes) events += count.by_process[process];
        cells.push_back(fmt::format("{}", events));
      }
      text += table.row("  " + count.name, cells);
    }
    first = end;
  }
  return text;
}

std::string start_section(const std::vector<StartResult>& starts) {
  if (starts.empty()) return "";
  const TextTable table(56, {12, 12});
  std::string text = "\n" + table.row("Start of processes", {"first node", "ready"});
  const auto cell = [](const std::optional<std::int64_t>& after) {
    return after ? format_duration(static_cast<double>(*after)) : std::string("-");
  };
  for (const StartResult& start : starts) {
    text += table.row(fmt::format("  {} [{}]", start.process, start.vpid),
                      {cell(start.node_after_ns), cell(start.ready_after_ns)});
  }
  return text + "  (after exec; ready: an executor looks for work)\n";
}

std::string owner_label(const CallbackResult& callback) {
  switch (callback.owner) {
    case CallbackResult::Owner::kSubscription:
      return "subscription " + callback.owner_name;
    case CallbackResult::Owner::kService:
      return "service " + callback.owner_name;
    case CallbackResult::Owner::kClient:
      return callback.owner_name.empty() ? fmt::format("client {:#x}", callback.address)
                                         : "client of " + callback.owner_name;
    case CallbackResult::Owner::kTimer:
      return "timer " + format_duration(static_cast<double>(callback.period_ns));
    case CallbackResult::Owner::kUnknown:
      return fmt::format("callback {:#x}", callback.address);
  }
  return "";
}

std::string node_label(const std::string& node, std::int64_t vpid, const TraceOverview& overview) {
  const auto process = std::find_if(overview.processes.begin(), overview.processes.end(),
                                    [&](const ProcessResult& candidate) { return candidate.vpid.value_or(0) == vpid; });
  const std::string label = process == overview.processes.end() ? "?" : process_label(*process);
  return node.empty() ? fmt::format("node unknown, {}", label) : fmt::format("{}, {}", node, label);
}

// The columns of durations after a label: first their titles, then the cells of one row.
TextTable duration_table() {
  constexpr std::size_t kDuration = 8;
  return {36, {8, kDuration, kDuration, kDuration, kDuration, kDuration, kDuration, kDuration}};
}

const std::vector<std::string> kDurationTitles{"count", "mean", "stddev", "min", "p50", "p90", "p99", "max"};

std::vector<std::string> duration_cells(const DurationSummary& took) {
  std::vector<std::string> cells{fmt::format("{}", took.count)};
  if (took.count == 0) return cells;
  cells.push_back(format_duration(took.mean_ns));
  cells.push_back(took.count == 1 ? "-" : format_duration(took.stddev_ns));
  for (const std::int64_t value : {took.min_ns, took.p50_ns, took.p90_ns, took.p99_ns, took.max_ns}) {
    cells.push_back(format_duration(static_cast<double>(value)));
  }
  return cells;
}

std::string callback_section(const TraceResults& results) {
  if (results.ros2.callbacks.empty()) return "";
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Callbacks", kDurationTitles);
  std::string last_node;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    const std::string node = node_label(callback.node, callback.vpid, results.overview);
    if (node != last_node) text += fmt::format("{}\n", node);
    last_node = node;
    text += table.row("  " + owner_label(callback), duration_cells(callback.durations));
    if (!callback.symbol.empty()) text += fmt::format("    {}\n", callback.symbol);
    if (callback.intra_process > 0) text += fmt::format("    {} of them intra-process\n", callback.intra_process);
    if (callback.unfinished > 0) text += fmt::format("    {} more without an end\n", callback.unfinished);
  }
  return text;
}

std::string topic_section(const Ros2Results& ros2) {
  constexpr std::size_t kDuration = 8;
  const TextTable table(23, {10, 9, 9, kDuration, kDuration, kDuration, kDuration, kDuration, kDuration});
  std::string text;
  std::size_t silent = 0;
  for (const TopicResult& topic : ros2.topics) {
    if (topic.published == 0 && topic.received == 0) {
      ++silent;
      continue;
    }
    const DurationSummary& latency = topic.latency;
    std::vector<std::string> cells{fmt::format("{}", topic.published), fmt::format("{}", topic.received),
                                   fmt::format("{}", topic.published_only)};
    if (latency.count > 0) {
      cells.push_back(format_duration(latency.mean_ns));
      for (const std::int64_t value :
           {latency.min_ns, latency.p50_ns, latency.p90_ns, latency.p99_ns, latency.max_ns}) {
        cells.push_back(format_duration(static_cast<double>(value)));
      }
    }
    text += table.row("  " + topic.name, cells);
    if (topic.received_only > 0) {
      text += fmt::format("    {} of those received were published outside the trace\n", topic.received_only);
    }
  }
  if (!text.empty()) {
    const std::string header =
        table.row("Topics", {"published", "received", "untaken", "mean", "min", "p50", "p90", "p99", "max"});
    text = "\n" + header + text +
           "  (times: from rmw_publish to callback_start; untaken: by any subscription in the trace)\n";
  }
  if (silent == 0) return text;
  return text +
         fmt::format("{}  ({} without messages)\n", text.empty() ? "\nTopics\n" : "", format_count(silent, "topic"));
}

std::string call_section(const Ros2Results& ros2) {
  if (ros2.calls.empty()) return "";
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Services", kDurationTitles);
  for (const CallResult& call : ros2.calls) {
    const auto name = [](const std::string& node, const std::optional<std::int64_t>& vpid) {
      return vpid ? node : std::string("unknown");
    };
    text += fmt::format("{}, {} asks {}\n", call.service, name(call.client, call.client_vpid),
                        name(call.server, call.server_vpid));
    text += table.row("  round trip", duration_cells(call.round_trip));
    text += table.row("    way to the service", duration_cells(call.request));
    text += table.row("    in the service", duration_cells(call.in_service));
    text += table.row("    way back", duration_cells(call.response));
    if (call.responses < call.requests) {
      text += fmt::format("    {} without a response\n", format_count(call.requests - call.responses, "request"));
    }
  }
  return text + "  (from rmw_send_request to rmw_take_response; in the service: from rmw_take_request on)\n";
}

std::string execution_label(const ExecutionResult& execution) {
  switch (execution.kind) {
    case ExecutionResult::Kind::kService:
      return execution.node.empty() ? fmt::format("service {:#x}", execution.address) : "service " + execution.service;
    case ExecutionResult::Kind::kClient:
      return execution.node.empty() ? fmt::format("client {:#x}", execution.address) : "client of " + execution.service;
    case ExecutionResult::Kind::kWaitable:
      return fmt::format("waitable {:#x}", execution.address);
  }
  return "";
}

std::string execution_section(const TraceResults& results) {
  if (results.ros2.executions.empty()) return "";
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Served by executors", kDurationTitles);
  std::string last_node;
  for (const ExecutionResult& execution : results.ros2.executions) {
    const std::string node = node_label(execution.node, execution.vpid, results.overview);
    if (node != last_node) text += fmt::format("{}\n", node);
    last_node = node;
    std::vector<std::string> cells = duration_cells(execution.durations);
    cells.front() = fmt::format("{}", execution.count);
    text += table.row("  " + execution_label(execution), cells);
  }
  return text + "  (until the response is sent, or the client's callback has ended)\n";
}

std::string notes(const TraceResults& results) {
  std::string text;
  const auto note = [&text](const std::string& sentence) { text += fmt::format("  {}\n", sentence); };
  const Ros2Results& ros2 = results.ros2;
  if (ros2.lacks_thread_context) {
    note("The session had no context vpid or vtid: processes and threads can't be told apart.");
  }
  if (ros2.unknown_messages > 0) {
    note(fmt::format("{} of publishers or subscriptions whose creation is not in the trace: was it started late?",
                     format_count(ros2.unknown_messages, "message")));
  }
  const auto estimated = [](const DurationSummary& summary) { return !summary.percentiles_are_exact; };
  if (std::any_of(ros2.callbacks.begin(), ros2.callbacks.end(),
                  [&](const CallbackResult& callback) { return estimated(callback.durations); }) ||
      std::any_of(ros2.topics.begin(), ros2.topics.end(),
                  [&](const TopicResult& topic) { return estimated(topic.latency); }) ||
      std::any_of(ros2.calls.begin(), ros2.calls.end(),
                  [&](const CallResult& call) { return estimated(call.round_trip) || estimated(call.request); })) {
    note(fmt::format("Percentiles of more than {} values are estimates from a random sample.",
                     DurationStatistics::kKept));
  }
  for (const std::string& warning : results.warnings) {
    note(fmt::format("{} (recorded by another version of ros2_tracing?)", warning));
  }
  return text.empty() ? "" : "\nNotes\n" + text;
}

}  // namespace

std::string text_report(const Report& report) {
  return trace_section(report) + loss_section(report) + event_section(report.results.overview) +
         start_section(report.results.starts) + callback_section(report.results) + topic_section(report.results.ros2) +
         call_section(report.results.ros2) + execution_section(report.results) + notes(report.results);
}

}  // namespace tracing
