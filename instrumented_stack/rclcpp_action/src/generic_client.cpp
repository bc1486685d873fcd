// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_action/generic_client.hpp"

#include <cstring>
#include <unique_identifier_msgs/msg/uuid.hpp>
#include <utility>

#include "message_layout.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp_action/create_generic_client.hpp"
#include "rclcpp_action/detail/add_to_node.hpp"

namespace rclcpp_action {
namespace {

// The response to a goal has no part of the action, so it is the same for all.
struct GoalResponseMessage {
  bool accepted;
  builtin_interfaces::msg::Time stamp;
};

GoalUUID goal_id_in(const void* message) {
  return static_cast<const unique_identifier_msgs::msg::UUID*>(message)->uuid;
}

}  // namespace

GenericClient::GenericClient(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
                             rclcpp::node_interfaces::NodeGraphInterface::SharedPtr /*node_graph*/,
                             rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging,
                             const std::string& action_name, std::shared_ptr<rclcpp::SharedLibrary> typesupport_lib,
                             const rosidl_action_type_support_t* action_typesupport_handle,
                             const rcl_action_client_options_t& client_options)
    : GoalClient(std::move(node_base), node_logging->get_logger(), action_name, action_typesupport_handle,
                 client_options),
      library_(std::move(typesupport_lib)),
      type_(*action_typesupport_handle) {}

std::shared_future<GenericClientGoalHandle::SharedPtr> GenericClient::async_send_goal(const Goal goal,
                                                                                      std::size_t goal_size,
                                                                                      const SendGoalOptions& options) {
  // Only the middleware reads this copy, while the goal exists. So it needs neither constructor nor destructor.
  const std::size_t offset = offset_of(ActionPart::kGoal, type_);
  const std::shared_ptr<void> request(::operator new(offset + goal_size), [](void* made) { ::operator delete(made); });
  const GoalUUID id = generate_goal_id();
  std::memcpy(request.get(), id.data(), id.size());
  std::memcpy(static_cast<char*>(request.get()) + offset, goal, goal_size);
  return send_goal(request, id, options);
}

std::shared_future<GenericClientGoalHandle::SharedPtr> GenericClient::async_send_goal(const GoalRequest goal_request,
                                                                                      const SendGoalOptions& options) {
  return send_goal(std::shared_ptr<void>(goal_request, [](void*) {}), goal_id_in(goal_request), options);
}

std::shared_ptr<void> GenericClient::create_goal_response() const {
  return rclcpp::detail::make_message(*type_.goal_service_type_support->response_typesupport);
}

std::shared_ptr<void> GenericClient::create_result_response() const {
  return rclcpp::detail::make_message(*type_.result_service_type_support->response_typesupport);
}

std::shared_ptr<void> GenericClient::create_feedback_message() const {
  return rclcpp::detail::make_message(*type_.feedback_message_type_support);
}

bool GenericClient::is_accepted(const void* untyped, builtin_interfaces::msg::Time& stamp) const {
  const auto* const response = static_cast<const GoalResponseMessage*>(untyped);
  stamp = response->stamp;
  return response->accepted;
}

// Such a request has nothing but the identity.
std::shared_ptr<void> GenericClient::create_result_request(const GoalUUID& goal_id) const {
  auto request = std::make_shared<unique_identifier_msgs::msg::UUID>();
  request->uuid = goal_id;
  return request;
}

GenericClient::WrappedResult GenericClient::result_in(const GoalUUID& goal_id,
                                                      const std::shared_ptr<void>& response) const {
  const auto* const bytes = static_cast<const char*>(response.get());
  return {goal_id, static_cast<ResultCode>(*bytes), bytes + offset_of(ActionPart::kResult, type_), response};
}

void GenericClient::handle_feedback_message(std::shared_ptr<void> message) {
  const void* const feedback = static_cast<const char*>(message.get()) + offset_of(ActionPart::kFeedback, type_);
  tell_feedback(goal_id_in(message.get()), feedback);
}

GenericClient::SharedPtr create_generic_client(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base_interface,
    rclcpp::node_interfaces::NodeGraphInterface::SharedPtr node_graph_interface,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging_interface,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr node_waitables_interface, const std::string& name,
    const std::string& type, rclcpp::CallbackGroup::SharedPtr group, const rcl_action_client_options_t& options) {
  const std::string identifier = "rosidl_typesupport_cpp";
  const std::shared_ptr<rclcpp::SharedLibrary> library = rclcpp::get_typesupport_library(type, identifier);
  const rosidl_action_type_support_t* const handle = rclcpp::get_action_typesupport_handle(type, identifier, *library);
  return detail::add_to_node(
      std::make_shared<GenericClient>(std::move(node_base_interface), std::move(node_graph_interface),
                                      std::move(node_logging_interface), name, library, handle, options),
      node_waitables_interface, group);
}

}  // namespace rclcpp_action
