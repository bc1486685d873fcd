// SPDX-License-Identifier: Apache-2.0
#include "tracing/plan/event_classes.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <set>

#include "tracing/plan/event_rule.hpp"
#include "tracing/plan/trace_config.hpp"

namespace tracing {
namespace {

using Patterns = std::vector<std::string>;

const std::map<std::string, Patterns>& classes() {
  static const std::map<std::string, Patterns> patterns = {
      {"executor", {"ros2:rclcpp_executor_*", "ros2_ext:rclcpp_executor_*"}},
      {"buffers",
       {"ros2:rclcpp_ring_buffer_enqueue", "ros2:rclcpp_ring_buffer_dequeue", "ros2:rclcpp_ring_buffer_clear"}},
      {"layers", {"ros2:rclcpp_publish", "ros2:rcl_publish", "ros2:rclcpp_take", "ros2:rcl_take"}},
      {"messages", {"ros2:rmw_publish", "ros2:rmw_take", "ros2:rclcpp_intra_publish"}},
      {"services",
       {"ros2:rmw_send_request", "ros2:rmw_take_request", "ros2:rmw_send_response", "ros2:rmw_take_response",
        "ros2_ext:rclcpp_client_callback_*"}},
      {"callbacks", {"ros2:callback_start", "ros2:callback_end"}}};
  return patterns;
}

bool is_initialisation(const std::string& event) {
  const std::vector<std::string>& names = initialisation_ros_events();
  return std::find(names.begin(), names.end(), event) != names.end();
}

bool matches(const std::string& pattern, const std::string& event) {
  return fnmatch(pattern.c_str(), event.c_str(), 0) == 0;
}

}  // namespace

const std::vector<std::string>& droppable_classes() {
  static const std::vector<std::string> order = {"executor", "buffers", "layers", "messages", "services", "callbacks"};
  return order;
}

std::vector<DroppableClass> plan_drops(const std::vector<std::string>& order,
                                       const std::vector<ChannelPlan>& channels) {
  std::vector<DroppableClass> drops;
  std::set<std::string> taken;
  for (const std::string& name : order) {
    const auto known = classes().find(name);
    const Patterns patterns = known != classes().end() ? known->second : Patterns{name};
    DroppableClass drop{.name = name, .rules = {}};
    for (const ChannelPlan& channel : channels) {
      if (channel.domain != LTTNG_DOMAIN_UST) continue;
      for (const EventRule& rule : channel.events) {
        const bool meant = std::any_of(patterns.begin(), patterns.end(),
                                       [&](const std::string& pattern) { return matches(pattern, rule.pattern); });
        if (!meant || is_initialisation(rule.pattern)) continue;
        if (taken.insert(channel.channel + "/" + rule.pattern).second) {
          drop.rules.push_back({.channel = channel.channel, .event = rule.pattern});
        }
      }
    }
    if (!drop.rules.empty()) drops.push_back(std::move(drop));
  }
  return drops;
}

void name_ros_events(std::vector<ChannelPlan>& channels) {
  for (ChannelPlan& channel : channels) {
    std::set<std::string> named;  // without a condition: an event of two such rules is recorded once
    std::vector<EventRule> rules;
    for (const EventRule& rule : channel.events) {
      if (!rule.pattern.starts_with("ros2:") || rule.pattern.find('*') == std::string::npos) {
        if (!rule.plain() || named.insert(rule.pattern).second) rules.push_back(rule);
        continue;
      }
      for (const std::string& event : default_ros_events()) {
        if (!matches(rule.pattern, event) || (rule.plain() && !named.insert(event).second)) continue;
        rules.push_back(rule);
        rules.back().pattern = event;
      }
    }
    channel.events = std::move(rules);
  }
}

}  // namespace tracing
