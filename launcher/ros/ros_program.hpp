// SPDX-License-Identifier: Apache-2.0
// Which program asks the nodes of an environment: that of launch_companion, which a workspace has built with the
// rclcpp and the middleware of its ROS 2 (programs/companion/), or the one of this installation over Fast DDS.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/environment/environment.hpp"

namespace launch {

// The path of `name` in the first prefix of AMENT_PREFIX_PATH that has launch_companion, or none. The companion of
// another version of this project is one, too.
std::optional<std::string> companion_program(std::string_view name, const Environment& environment);

// The same, else the path in this installation, which need not exist. Throws LaunchError if the companion is of another
// version than this program, and if there is none although the middleware of the environment is none of DDS.
std::string ros_program(std::string_view name, const Environment& environment);

// Whether a program that ros_program() returned is of launch_companion: it has the libraries of the environment.
bool is_of_companion(std::string_view program);

}  // namespace launch
