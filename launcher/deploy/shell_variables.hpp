// SPDX-License-Identifier: Apache-2.0
// Which variables of a shell, in which the set-up files have been sourced, a launch needs elsewhere.
#pragma once

#include <string_view>

namespace launch {

// Of ROS 2, its middlewares, LTTng and the set-up files: "ROS_DOMAIN_ID".
bool is_setting_variable(std::string_view name);
// Where a prefix is: "AMENT_PREFIX_PATH", "PATH", "LD_LIBRARY_PATH".
bool is_path_variable(std::string_view name);

}  // namespace launch
