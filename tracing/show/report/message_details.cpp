// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/details.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

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
  if (silent == 0) {
    return text;
  }
  return text +
         fmt::format("{}  ({} without messages)\n", text.empty() ? "\nTopics\n" : "", format_count(silent, "topic"));
}

std::string delivery_section(const TraceResults& results) {
  if (results.ros2.subscriptions.empty()) {
    return "";
  }
  const TextTable table(36, {8, 8, 8, 8, 8, 8, 8, 8});
  std::string text;
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    text += fmt::format("{} to {}\n", subscription.topic,
                        node_label(subscription.node, subscription.process, results.overview));
    const auto part = [&](const char* name, const DurationSummary& took) {
      if (took.count > 0) {
        text += table.row(name, duration_cells(took));
      }
    };
    part("  in all", subscription.latency);
    part("    rclcpp", subscription.rclcpp);
    part("    rcl", subscription.rcl);
    part("    on the way", subscription.transport);
    part("    waiting for the executor", subscription.executor);
    part("    from the take to the callback", subscription.take);
    const auto lost = [&](const char* where, std::uint64_t count) {
      if (count > 0) {
        text += fmt::format("    {} {}\n", count, where);
      }
    };
    lost("pushed out of the full queue of the subscription", subscription.overwritten);
    lost("pushed out of the full buffer within the process", subscription.overwritten_in_buffer);
    lost("pushed out of the full queue of the publisher", subscription.lost_by_publisher);
    lost("lost in the network or in shared memory: not reliable", subscription.lost_in_transport);
    lost("lost on the way, or filtered", subscription.lost_unplaced());
    lost("taken, but given to no callback", subscription.not_executed);
    lost("published before the first one that came", subscription.before_first);
    lost("published after the last one that came", subscription.after_last);
  }
  return "\n" + table.row("Ways of messages", duration_titles()) + text +
         "  (from the first publish function to callback_start)\n";
}

std::string chain_section(const TraceResults& results) {
  const Ros2Results& ros2 = results.ros2;
  const Hosts hosts(results.overview);
  if (ros2.chains.empty()) {
    return "";
  }
  std::string text = "\n" + duration_table().row("Chains", duration_titles());
  for (const ChainResult& chain : ros2.chains) {
    text += chain_details(chain, hosts);
  }
  if (!ros2.has_all_chains) {
    text += "  (there were more chains than a report holds)\n";
  }
  return text +
         "  (response: from an input to the first output; age: to the last one; reaction: from the input before)\n";
}

std::string call_section(const TraceResults& results) {
  const Ros2Results& ros2 = results.ros2;
  const Hosts hosts(results.overview);
  if (ros2.calls.empty()) {
    return "";
  }
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Services", duration_titles());
  for (const CallResult& call : ros2.calls) {
    const auto name = [&hosts](const std::string& node, const std::optional<ProcessIndex>& process) {
      return process ? hosts.before(process) + node : std::string("unknown");
    };
    text += fmt::format("{}, {} asks {}\n", call.service, name(call.client, call.client_process),
                        name(call.server, call.server_process));
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
  if (results.ros2.executions.empty()) {
    return "";
  }
  const TextTable table = duration_table();
  std::string text = "\n" + table.row("Served by executors", duration_titles());
  std::string last_node;
  for (const ExecutionResult& execution : results.ros2.executions) {
    const std::string node = node_label(execution.node, execution.process, results.overview);
    if (node != last_node) {
      text += fmt::format("{}\n", node);
    }
    last_node = node;
    std::vector<std::string> cells = duration_cells(execution.durations);
    cells.front() = fmt::format("{}", execution.count);
    text += table.row("  " + execution_label(execution), cells);
  }
  return text + "  (until the response is sent, or the client's callback has ended)\n";
}

}  // namespace

std::string chain_details(const ChainResult& chain, const Hosts& hosts) {
  const TextTable table = duration_table();
  std::string text;
  for (const ChainResult::Step& step : chain.steps) {
    if (!step.topic.empty()) {
      text += table.row("    until it publishes", duration_cells(step.until_publish));
      text += table.row(fmt::format("    {} on its way", step.topic), duration_cells(step.transfer));
    }
    text += fmt::format("  {}{}, {}\n", hosts.before(step.process), step.node.empty() ? "node unknown" : step.node,
                        step.callback);
  }
  if (chain.is_loop) {
    text += "    (a loop: the chain is not followed further)\n";
  }
  text += table.row("  response", duration_cells(chain.response));
  text += table.row("  reaction", duration_cells(chain.reaction));
  return text + table.row("  age", duration_cells(chain.age));
}

std::string message_details(const TraceResults& results) {
  return topic_section(results.ros2) + delivery_section(results) + chain_section(results) + call_section(results) +
         execution_section(results);
}

}  // namespace tracing
