// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/trace_session.hpp"

#include <fmt/format.h>

#include "base/text/quoted_text.hpp"

namespace launch {

namespace {

constexpr const char* kSession = "test";

// A text as the value of an attribute: `$` and `\\` mean something in launch files.
std::string attribute(const std::string& text) {
  std::string value;
  for (const char c : text) {
    if (c == '$' || c == '\\') {
      value += '\\';
    }
    value += c;
  }
  return as_xml_text(value);
}

}  // namespace

std::string trace_directory(const std::string& directory) {
  return directory + "/trace";
}

std::string own_trace_directory(const std::string& directory) {
  return directory + "/own_traces";
}

std::shared_ptr<const LaunchDescription> recorded(const LaunchDescription& description, const Registry& registry,
                                                  const std::string& directory,
                                                  const std::vector<std::string>& other_events) {
  std::string events = "ros2:* ros2_ext:*";
  for (const std::string& name : other_events) {
    events += " '" + name + "'";
  }
  // ROS 2's buffers of 32 KiB lose events when many processes start.
  const std::string text = fmt::format(
      "<launch><trace session-name=\"{}\" base-path=\"{}\" events-ust=\"{}\" "
      "subbuffer-size-ust=\"1048576\"/></launch>",
      kSession, attribute(trace_directory(directory)), attribute(events));
  const auto trace = parse_launch_description(std::make_shared<SourceFile>("launch test", text), registry);
  auto with_trace = std::make_shared<LaunchDescription>(description);
  with_trace->actions.insert(with_trace->actions.begin(), trace->actions.begin(), trace->actions.end());
  return with_trace;
}

}  // namespace launch
