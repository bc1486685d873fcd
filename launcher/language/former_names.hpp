// SPDX-License-Identifier: Apache-2.0
// The names in ROS 2 of what ROS 1's roslaunch, or an engine beside it, calls by another name.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// The help for an element or an attribute that does not exist; empty when nothing is known about it.
std::string help_for_former_tag(std::string_view tag);
std::string help_for_former_attribute(std::string_view tag, std::string_view attribute);

}  // namespace launch
