// SPDX-License-Identifier: Apache-2.0
// Converts between ROS names and DDS names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rmw_fastrtps {

// `/chatter` → `rt/chatter`
std::string mangled_topic(std::string_view topic);

// `rt/chatter` → `/chatter`; empty for a DDS topic that is not a ROS topic.
std::optional<std::string> demangled_topic(std::string_view dds_topic);

// `/add` → `rq/addRequest` and `rr/addReply`
std::string mangled_request_topic(std::string_view service);
std::string mangled_response_topic(std::string_view service);

// `rq/addRequest` and `rr/addReply` → `/add`; empty for a DDS topic that belongs to no service.
std::optional<std::string> demangled_service(std::string_view dds_topic);

// `example_interfaces::srv::dds_::AddTwoInts_Request_` → `example_interfaces/srv/AddTwoInts`; responses likewise.
std::string demangled_service_type(std::string_view dds_type);

// `std_msgs::msg::dds_::String_` → `std_msgs/msg/String`; leaves other names alone.
std::string demangled_type(std::string_view dds_type);

}  // namespace rmw_fastrtps
