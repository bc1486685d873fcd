// Between ROS names and DDS names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rmw_fastrtps {

// `/chatter` → `rt/chatter`
std::string mangled_topic(std::string_view topic);

// `rt/chatter` → `/chatter`; nothing for a DDS topic that is no ROS topic.
std::optional<std::string> demangled_topic(std::string_view dds_topic);

// `std_msgs::msg::dds_::String_` → `std_msgs/msg/String`; other names are left alone.
std::string demangled_type(std::string_view dds_type);

}  // namespace rmw_fastrtps
