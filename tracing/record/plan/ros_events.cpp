// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/ros_events.hpp"

#include <fmt/core.h>
#include <fnmatch.h>

#include "base/text/names.hpp"
#include "tracetools/event_table.h"

namespace tracing {

const std::vector<RosEvent>& all_ros_events() {
#define TRACING_ROS_EVENT(provider, name, Struct, group, ...) {provider ":" #name, #group},
  static const std::vector<RosEvent> events = {TRACETOOLS_EVENT_TABLE(TRACING_ROS_EVENT, "ros2")
                                                   TRACETOOLS_EXT_EVENT_TABLE(TRACING_ROS_EVENT, "ros2_ext")};
#undef TRACING_ROS_EVENT
  return events;
}

std::string why_no_ros_event(const std::string& pattern) {
  if (!pattern.starts_with("ros2:") && !pattern.starts_with("ros2_ext:")) {
    return "";
  }
  std::vector<std::string> names;
  for (const RosEvent& event : all_ros_events()) {
    if (fnmatch(pattern.c_str(), event.name.c_str(), 0) == 0) {
      return "";
    }
    names.push_back(event.name);
  }
  const std::string nearest = launch::nearest_name(pattern, names);
  return fmt::format("ROS 2 has no event '{}'{}", pattern,
                     nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

const std::vector<std::string>& default_ros_events() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const RosEvent& event : all_ros_events()) {
      if (event.name.starts_with("ros2:")) {
        all.push_back(event.name);
      }
    }
    return all;
  }();
  return names;
}

const std::vector<std::string>& initialisation_ros_events() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> initialisation;
    for (const RosEvent& event : all_ros_events()) {
      if (event.name.starts_with("ros2:") && event.group == "init") {
        initialisation.push_back(event.name);
      }
    }
    return initialisation;
  }();
  return names;
}

}  // namespace tracing
