// SPDX-License-Identifier: Apache-2.0
// The run-time events of ROS 2 in classes, for a trace that must not cost more than it is given: a class is dropped as
// a whole, so that what remains can still be understood.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracing/plan/channel_plan.hpp"

namespace tracing {

// What can be dropped, in the order in which it is unless another is asked for:
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

// What `order` names and `channels` record, without what is empty. An entry is a class, or a pattern of events, with
// the provider. Initialisation events are in none: without them nothing of a trace can be understood.
std::vector<DroppableClass> plan_drops(const std::vector<std::string>& order, const std::vector<ChannelPlan>& channels);

// Puts the names of the events in the place of patterns of provider ros2: LTTng can only switch off what it was given.
void name_ros_events(std::vector<ChannelPlan>& channels);

}  // namespace tracing
