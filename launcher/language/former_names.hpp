// SPDX-License-Identifier: Apache-2.0
// What to write in ROS 2 for what ROS 1's roslaunch, or an engine beside it, calls otherwise.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// Help for an element or an attribute that does not exist; empty when nothing is known of it.
std::string help_for_former_tag(std::string_view tag);
std::string help_for_former_attribute(std::string_view tag, std::string_view attribute);

}  // namespace launch
