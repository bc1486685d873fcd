// SPDX-License-Identifier: Apache-2.0
// The run-time events of ROS 2 in classes, for a trace whose cost is limited: a class is dropped as a whole, so that
// the remaining events can still be understood.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

// The classes, in the order in which they are dropped unless the configuration gives another order:
//   executor   what executors look for and take up
//   buffers    what goes through the ring buffers of intra-process communication
//   layers     publishing and taking as rclcpp and rcl see it: rmw's events of the same messages stay
//   messages   publishing and taking as rmw sees it, and within the process
//   services   requests and responses
//   callbacks  beginning and end of callbacks
const std::vector<std::string>& droppable_classes();

// A rule of a channel, as LTTng was given it.
struct DroppableRule {
  std::string channel;
  std::string event;
};

struct DroppableClass {
  std::string name;
  std::vector<DroppableRule> rules;
};

// The classes that `order` names, each with the rules of `channels` that belong to it. A class without rules is left
// out. An entry of `order` is the name of a class, or a pattern of events with its provider. Initialisation events are
// in no class: without them a trace cannot be understood.
std::vector<DroppableClass> plan_drops(const std::vector<std::string>& order, const std::vector<ChannelPlan>& channels);

}  // namespace tracing
