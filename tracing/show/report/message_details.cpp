// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

std::string topic_remarks(const TopicResult& topic) {
  const std::pair<std::uint64_t, const char*> parts[] = {
      {topic.received_only, "of those received have no publication in the trace"},
      {topic.estimated, "of those received are an estimate: their publication was found by its time"},
      {topic.unidentified, "of those received may be any of several publications, or of none in the trace"},
      {topic.undecided, "of those published may have been taken or not"},
  };
  std::string text;
  for (const auto& [count, what] : parts) {
    if (count > 0) {
      text += fmt::format("    {} {}\n", count, what);
    }
  }
  return text;
}

std::string topic_section(const Ros2Results& ros2) {
  std::vector<TopicResult> spoken;
  for (const TopicResult& topic : ros2.topics) {
    if (topic.published > 0 || topic.received > 0) {
      spoken.push_back(topic);
    }
  }
  Section<TopicResult> section{
      .title = "Topics",
      .label_width = 23,
      .columns = {{"published", 10, number_of(&TopicResult::published)},
                  {"received", 9, number_of(&TopicResult::received)},
                  {"untaken", 9, number_of(&TopicResult::published_only)}},
      .label = [](const TopicResult& topic) { return "  " + topic.name + (topic.is_estimated() ? " ~" : ""); },
      .more = topic_remarks,
      .end = "  (times: from rmw_publish to callback_start; untaken: by any subscription in the trace)\n"};
  for (const auto& column : duration_columns(&TopicResult::latency)) {
    if (column.title != std::string_view("count") && column.title != std::string_view("stddev")) {
      section.columns.push_back(column);
    }
  }
  const std::string text = section.text(spoken);
  const std::size_t silent = ros2.topics.size() - spoken.size();
  if (silent == 0) {
    return text;
  }
  return text +
         fmt::format("{}  ({} without messages)\n", text.empty() ? "\nTopics\n" : "", format_count(silent, "topic"));
}

// A part of the way of messages, or of a call, and its place in the result.
template <class Result>
struct Part {
  const char* name;
  DurationSummary Result::*took;
};

constexpr Part<SubscriptionResult> kParts[] = {
    {"  in all", &SubscriptionResult::latency},
    {"    rclcpp", &SubscriptionResult::rclcpp},
    {"    rcl", &SubscriptionResult::rcl},
    {"    on the way", &SubscriptionResult::transport},
    {"    waiting for the executor", &SubscriptionResult::executor},
    {"    from the take to the callback", &SubscriptionResult::take},
};

constexpr Part<CallResult> kCallParts[] = {
    {"  round trip", &CallResult::round_trip},
    {"    way to the service", &CallResult::request},
    {"    in the service", &CallResult::in_service},
    {"    way back", &CallResult::response},
};

std::string delivery_section(const TraceResults& results) {
  if (results.ros2.subscriptions.empty()) {
    return "";
  }
  std::string text = "\n" + duration_header("Ways of messages");
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    text += fmt::format("{} to {}{}\n", subscription.topic,
                        node_label(subscription.node, subscription.process, results.overview),
                        subscription.estimated > 0 ? " ~" : "");
    for (const auto& [name, took] : kParts) {
      if ((subscription.*took).count > 0) {
        text += duration_row(name, subscription.*took);
      }
    }
    const std::pair<std::uint64_t, const char*> lost[] = {
        {subscription.overwritten, "pushed out of the full queue of the subscription"},
        {subscription.overwritten_in_buffer, "pushed out of the full buffer within the process"},
        {subscription.lost_by_publisher, "pushed out of the full queue of the publisher"},
        {subscription.lost_in_transport, "lost in the network or in shared memory: not reliable"},
        {subscription.lost_unplaced(), "lost on the way, or filtered"},
        {subscription.filtered, "not let through by the filter of the subscription, or lost"},
        {subscription.not_executed, "taken, but given to no callback"},
        {subscription.before_first, "published before the first one that came"},
        {subscription.after_last, "published after the last one that came"},
    };
    for (const auto& [count, where] : lost) {
      if (count > 0) {
        text += fmt::format("    {} {}\n", count, where);
      }
    }
  }
  return text + "  (from the first publish function to callback_start)\n";
}

std::string chain_section(const TraceResults& results) {
  const Ros2Results& ros2 = results.ros2;
  if (ros2.chains.empty()) {
    return "";
  }
  const Hosts hosts(results.overview);
  std::string text = "\n" + duration_header("Chains");
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
  if (results.ros2.calls.empty()) {
    return "";
  }
  const Hosts hosts(results.overview);
  const auto name = [&hosts](const std::string& node, const std::optional<ProcessIndex>& process) {
    return process ? hosts.before(process) + node : std::string("unknown");
  };
  std::string text = "\n" + duration_header("Services");
  for (const CallResult& call : results.ros2.calls) {
    text += fmt::format("{}, {} asks {}\n", call.service, name(call.client, call.client_process),
                        name(call.server, call.server_process));
    for (const auto& [part, took] : kCallParts) {
      text += duration_row(part, call.*took);
    }
    if (call.unanswered() > 0) {
      text += fmt::format("    {} without a response\n", format_count(call.unanswered(), "request"));
    }
    if (call.in_flight > 0) {
      text += fmt::format("    {} in flight at the end\n", format_count(call.in_flight, "request"));
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
  Section<ExecutionResult> section{
      .title = "Served by executors",
      .label_width = kDurationLabel,
      .columns = duration_columns(&ExecutionResult::durations),
      .label = [](const ExecutionResult& execution) { return "  " + execution_label(execution); },
      .group =
          [&](const ExecutionResult& execution) {
            return node_label(execution.node, execution.process, results.overview);
          },
      .end = "  (until the response is sent, or the client's callback has ended)\n"};
  section.columns.front().cell = number_of(&ExecutionResult::count);
  return section.text(results.ros2.executions);
}

}  // namespace

std::string chain_details(const ChainResult& chain, const Hosts& hosts) {
  std::string text;
  for (const ChainResult::Step& step : chain.steps) {
    if (!step.topic.empty()) {
      text += duration_row("    until it publishes", step.until_publish);
      text += duration_row(fmt::format("    {} on its way", step.topic), step.transfer);
    }
    text += fmt::format("  {}{}, {}{}\n", hosts.before(step.process), step.node.empty() ? "node unknown" : step.node,
                        step.callback, chain.estimated && &step == &chain.steps.front() ? " ~" : "");
  }
  if (chain.is_loop) {
    text += "    (a loop: the chain is not followed further)\n";
  }
  text += duration_row("  response", chain.response);
  text += duration_row("  reaction", chain.reaction);
  return text + duration_row("  age", chain.age);
}

std::string message_details(const TraceResults& results) {
  return topic_section(results.ros2) + delivery_section(results) + chain_section(results) + call_section(results) +
         execution_section(results);
}

}  // namespace tracing
