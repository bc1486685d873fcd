// SPDX-License-Identifier: Apache-2.0
// What a change of parameters needs: the node held meanwhile, the callbacks, and what descriptors allow.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/node_interfaces/node_parameters.hpp"
#include "rclcpp/parameter_value.hpp"

namespace rclcpp {

// Unsuccessful, with a reason, if the value violates the type (unless dynamically typed) or the range.
rcl_interfaces::msg::SetParametersResult check_constraints(const rcl_interfaces::msg::ParameterDescriptor& descriptor,
                                                           const ParameterValue& value);

// The reason for a value of the wrong type.
std::string wrong_type_reason(const std::string& name, ParameterType expected, ParameterType actual);

}  // namespace rclcpp

namespace rclcpp::detail {

// The living handles of a list of callbacks, which live as long as their handles. They are held so that a callback can
// remove itself.
template <typename HandleT>
std::vector<std::shared_ptr<HandleT>> living(std::list<std::weak_ptr<HandleT>>& handles) {
  std::vector<std::shared_ptr<HandleT>> result;
  handles.remove_if([&result](const std::weak_ptr<HandleT>& weak) {
    auto handle = weak.lock();
    if (handle) {
      result.push_back(std::move(handle));
    }
    return weak.expired();
  });
  return result;
}

template <typename HandleT, typename CallbackT>
std::shared_ptr<HandleT> add_handle(std::list<std::weak_ptr<HandleT>>& handles, CallbackT callback) {
  auto handle = std::make_shared<HandleT>();
  handle->callback = std::move(callback);
  handles.push_front(handle);  // the newest is called first
  return handle;
}

}  // namespace rclcpp::detail

namespace rclcpp::node_interfaces {

// Held while the parameters of a node change. If a callback tries to change parameters too, it is refused.
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
