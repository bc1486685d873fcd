// SPDX-License-Identifier: Apache-2.0
// Copies the parameters of one node to another one.
#pragma once

#include <string>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"

namespace rclcpp {

// The arguments are pointers to nodes of any class. A parameter that the destination does not have is declared there
// with the source's descriptor. One that it has keeps its value, unless `override_existing_params`; then a refusal is a
// warning in the log. Throws what reading a parameter without a value throws.
template <typename NodeT1, typename NodeT2>
void copy_all_parameter_values(const NodeT1& source, const NodeT2& destination,
                               const bool override_existing_params = false) {
  const auto from = source->get_node_parameters_interface();
  const auto to = destination->get_node_parameters_interface();
  const Logger logger = destination->get_node_logging_interface()->get_logger();
  const std::vector<std::string> names = from->list_parameters({}, 0).names;
  const auto descriptors = from->describe_parameters(names);
  for (size_t i = 0; i < names.size(); ++i) {
    const Parameter parameter = from->get_parameter(names[i]);
    if (!to->has_parameter(names[i])) {
      to->declare_parameter(names[i], parameter.get_parameter_value(), descriptors[i]);
      continue;
    }
    if (!override_existing_params) {
      continue;
    }
    const auto result = to->set_parameters_atomically({parameter});
    if (!result.successful) {
      RCLCPP_WARN(logger, "Unable to set parameter (%s): %s!", names[i].c_str(), result.reason.c_str());
    }
  }
}

}  // namespace rclcpp
