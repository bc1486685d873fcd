// SPDX-License-Identifier: Apache-2.0
// Sends goals to the server of an action whose type is known only by name, at run time. Created by
// create_generic_client().
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <string>

#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/typesupport_helpers.hpp"
#include "rclcpp_action/detail/goal_client.hpp"
#include "rclcpp_action/generic_client_goal_handle.hpp"

namespace rclcpp_action {

// Goals, feedback and results are messages of C++ in memory. All functions may be called from any thread. Callbacks run
// in the executor. What it can do with goals that it has sent is in detail::GoalClient.
class GenericClient : public detail::GoalClient<GenericClientGoalHandle> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(GenericClient)

  using Goal = void*;         // a Goal of the action
  using GoalRequest = void*;  // a request of its service for goals: an identity, then a Goal

  // `typesupport_lib` has the type support, and is kept. Throws rclcpp::exceptions::RCLError, for example for a wrong
  // name.
  GenericClient(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
                rclcpp::node_interfaces::NodeGraphInterface::SharedPtr node_graph,
                rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging, const std::string& action_name,
                std::shared_ptr<rclcpp::SharedLibrary> typesupport_lib,
                const rosidl_action_type_support_t* action_typesupport_handle,
                const rcl_action_client_options_t& client_options = rcl_action_client_get_default_options());

  // `goal_size` is sizeof the Goal, which is not needed any more when the function returns. The future gets null if the
  // goal was rejected. Throws rclcpp::exceptions::RCLError.
  std::shared_future<GenericClientGoalHandle::SharedPtr> async_send_goal(const Goal goal, std::size_t goal_size,
                                                                         const SendGoalOptions& options = {});
  // The same with the identity that the request has.
  std::shared_future<GenericClientGoalHandle::SharedPtr> async_send_goal(const GoalRequest goal_request,
                                                                         const SendGoalOptions& options = {});

 private:
  std::shared_ptr<void> create_goal_response() const override;
  std::shared_ptr<void> create_result_response() const override;
  std::shared_ptr<void> create_feedback_message() const override;
  bool is_accepted(const void* response, builtin_interfaces::msg::Time& stamp) const override;
  std::shared_ptr<void> create_result_request(const GoalUUID& goal_id) const override;
  WrappedResult result_in(const GoalUUID& goal_id, const std::shared_ptr<void>& response) const override;
  void handle_feedback_message(std::shared_ptr<void> message) override;

  std::shared_ptr<rclcpp::SharedLibrary> library_;
  const rosidl_action_type_support_t& type_;
};

}  // namespace rclcpp_action
