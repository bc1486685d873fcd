// SPDX-License-Identifier: Apache-2.0
// Names in a recording that are not those of a user.
#pragma once

#include <string>

namespace tracing::twin {

// A service that every node of rclcpp has anyway.
bool is_own_service(const std::string& name);
bool is_of_action(const std::string& name);
// A name with a part that begins with an underscore: "/container/_container/load_node".
bool is_hidden(const std::string& name);
// A topic that nodes have without their program's doing.
bool is_own_topic(const std::string& name);

}  // namespace tracing::twin
