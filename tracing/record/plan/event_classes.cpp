// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/event_classes.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "tracetools/event_table.h"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/ros_events.hpp"

namespace tracing {
namespace {

// In the order in which they are dropped. The groups of events that are not among them stay.
constexpr std::array<std::string_view, 6> kDroppable = {"executor", "buffers",  "layers",
                                                        "messages", "services", "callbacks"};
constexpr std::array<std::string_view, 3> kStaying = {"init", "end", "state"};

constexpr bool is_one_of(const auto& groups, std::string_view group) {
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

#define CHECK_GROUP(given, name, Struct, group, ...)                          \
  static_assert(is_one_of(kDroppable, #group) || is_one_of(kStaying, #group), \
                #name ": say here whether events of group " #group " may be dropped");
TRACETOOLS_EVENT_TABLE(CHECK_GROUP, )
TRACETOOLS_EXT_EVENT_TABLE(CHECK_GROUP, )
#undef CHECK_GROUP

bool is_initialisation(const std::string& event) {
  const std::vector<std::string>& names = initialisation_ros_events();
  return std::find(names.begin(), names.end(), event) != names.end();
}

bool matches(const std::string& pattern, const std::string& event) {
  return fnmatch(pattern.c_str(), event.c_str(), 0) == 0;
}

// Whether `pattern` records events of this group and no other event of ROS 2.
bool records_only(const std::string& pattern, std::string_view group) {
  bool any = false;
  for (const RosEvent& event : all_ros_events()) {
    if (!matches(pattern, event.name)) {
      continue;
    }
    if (event.group != group) {
      return false;
    }
    any = true;
  }
  return any;
}

}  // namespace

const std::vector<std::string>& droppable_classes() {
  static const std::vector<std::string> order(kDroppable.begin(), kDroppable.end());
  return order;
}

std::vector<DroppableClass> plan_drops(const std::vector<std::string>& order,
                                       const std::vector<ChannelPlan>& channels) {
  std::vector<DroppableClass> drops;
  std::set<std::string> taken;
  for (const std::string& name : order) {
    const bool is_class = is_one_of(kDroppable, name);
    DroppableClass drop{.name = name, .rules = {}};
    for (const ChannelPlan& channel : channels) {
      if (channel.domain != LTTNG_DOMAIN_UST) {
        continue;
      }
      for (const EventRule& rule : channel.events) {
        const bool meant = is_class ? records_only(rule.pattern, name) : matches(name, rule.pattern);
        if (!meant || is_initialisation(rule.pattern)) {
          continue;
        }
        if (taken.insert(channel.channel + "/" + rule.pattern).second) {
          drop.rules.push_back({.channel = channel.channel, .event = rule.pattern});
        }
      }
    }
    if (!drop.rules.empty()) {
      drops.push_back(std::move(drop));
    }
  }
  return drops;
}

}  // namespace tracing
