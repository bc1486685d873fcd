// SPDX-License-Identifier: Apache-2.0
// The events of ROS 2 by their names, in the order of the declaration by which tracetools records them.
#pragma once

#include <string>
#include <vector>

namespace tracing {

struct RosEvent {
  std::string name;   // with the provider: "ros2:rcl_init"
  std::string group;  // what it tells of, as tracetools/event_table.h describes it: "init"
};

// Of the providers `ros2` and `ros2_ext`.
const std::vector<RosEvent>& all_ros_events();

// "ROS 2 has no event 'ros2:rcl_inti'; did you mean 'ros2:rcl_init'?", for a pattern of provider `ros2` or `ros2_ext`
// that takes none of these events. "" for others.
std::string why_no_ros_event(const std::string& pattern);

// The 42 events of provider `ros2`, and those that describe objects once (initialisation events).
const std::vector<std::string>& default_ros_events();
const std::vector<std::string>& initialisation_ros_events();

}  // namespace tracing
