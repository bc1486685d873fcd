// SPDX-License-Identifier: Apache-2.0
// Held while the parameters of a node change. If a callback tries to change parameters too, it is refused.
#pragma once

#include <mutex>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/node_interfaces/node_parameters.hpp"

namespace rclcpp::node_interfaces {

class NodeParameters::ChangeScope {
 public:
  explicit ChangeScope(NodeParameters& parameters) : lock_(parameters.mutex_), parameters_(parameters) {
    if (parameters_.changing_) {
      throw exceptions::ParameterModifiedInCallbackException(
          "cannot set or declare a parameter, or change the callback from within set callback");
    }
    parameters_.changing_ = true;
  }
  ~ChangeScope() { parameters_.changing_ = false; }
  RCLCPP_DISABLE_COPY(ChangeScope)

 private:
  std::lock_guard<std::recursive_mutex> lock_;
  NodeParameters& parameters_;
};

}  // namespace rclcpp::node_interfaces
