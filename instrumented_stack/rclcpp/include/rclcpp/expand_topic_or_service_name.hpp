// SPDX-License-Identifier: Apache-2.0
// Expands the name of a topic or service to its full name.
#pragma once

#include <string>

namespace rclcpp {

// Expands `name` for a node `node_name` in `namespace_`. It may be relative, private or contain substitutions; no remap
// rule applies. Throws exceptions::InvalidTopicNameError, exceptions::InvalidServiceNameError,
// exceptions::InvalidNodeNameError, exceptions::InvalidNamespaceError or exceptions::RCLError.
std::string expand_topic_or_service_name(const std::string& name, const std::string& node_name,
                                         const std::string& namespace_, bool is_service = false);

}  // namespace rclcpp
