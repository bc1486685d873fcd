// SPDX-License-Identifier: Apache-2.0
// The common part of the nodes that change their own parameters as another node would.
#pragma once

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "rcl_interfaces/msg/parameter_event.hpp"
#include "rclcpp/rclcpp.hpp"

namespace demo_nodes_cpp {

// Returns false if the program is interrupted.
template <typename ClientT>
bool wait_for_service(ClientT& client, const rclcpp::Logger& logger) {
  while (!client.wait_for_service(std::chrono::seconds(1))) {
    if (!rclcpp::ok()) {
      RCLCPP_ERROR(logger, "Interrupted while waiting for the service. Exiting.");
      return false;
    }
    RCLCPP_INFO(logger, "service not available, waiting again...");
  }
  return true;
}

template <typename ResultsT>
void report_failures(const ResultsT& results, const rclcpp::Logger& logger) {
  for (const auto& result : results) {
    if (!result.successful) {
      RCLCPP_ERROR(logger, "Failed to set parameter: %s", result.reason.c_str());
    }
  }
}

inline std::string to_text(const rcl_interfaces::msg::ListParametersResult& list) {
  std::ostringstream text;
  text << "\nParameter names:";
  for (const std::string& name : list.names) {
    text << "\n " << name;
  }
  text << "\nParameter prefixes:";
  for (const std::string& prefix : list.prefixes) {
    text << "\n " << prefix;
  }
  return text.str();
}

inline std::string to_text(const std::vector<rclcpp::Parameter>& parameters) {
  std::ostringstream text;
  for (const rclcpp::Parameter& parameter : parameters) {
    text << "\nParameter name: " << parameter.get_name() << "\nParameter value (" << parameter.get_type_name()
         << "): " << parameter.value_to_string();
  }
  return text.str();
}

inline std::string to_text(const rcl_interfaces::msg::ParameterEvent& event) {
  std::ostringstream text;
  const auto add = [&text](const char* what, const auto& parameters) {
    text << "\n " << what << " parameters:";
    for (const auto& parameter : parameters) {
      text << "\n  " << parameter.name;
    }
  };
  text << "\nParameter event:";
  add("new", event.new_parameters);
  add("changed", event.changed_parameters);
  add("deleted", event.deleted_parameters);
  text << '\n';
  return text.str();
}

}  // namespace demo_nodes_cpp
