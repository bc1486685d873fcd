// SPDX-License-Identifier: Apache-2.0
// Sends goals to the server of an action. Created by create_client().
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "rclcpp_action/client_base.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rclcpp_action/detail/goal_client.hpp"
#include "rosidl_typesupport_cpp/action_type_support.hpp"

namespace rclcpp_action {

// All functions may be called from any thread. Callbacks run in the executor. What it can do with goals that it has
// sent is in detail::GoalClient.
template <typename ActionT>
class Client : public detail::GoalClient<ClientGoalHandle<ActionT>>,
               public std::enable_shared_from_this<Client<ActionT>> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Client)

  using Goal = typename ActionT::Goal;
  using Feedback = typename ActionT::Feedback;
  using GoalHandle = ClientGoalHandle<ActionT>;
  using WrappedResult = typename GoalHandle::WrappedResult;
  using typename detail::GoalClient<GoalHandle>::SendGoalOptions;

  Client(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, const rclcpp::Logger& logger,
         const std::string& action_name,
         const rcl_action_client_options_t& options = rcl_action_client_get_default_options())
      : detail::GoalClient<GoalHandle>(std::move(node_base), logger, action_name,
                                       rosidl_typesupport_cpp::get_action_type_support_handle<ActionT>(), options) {}

  // The future gets null if the goal was rejected. Throws rclcpp::exceptions::RCLError.
  std::shared_future<typename GoalHandle::SharedPtr> async_send_goal(const Goal& goal,
                                                                     const SendGoalOptions& options = {}) {
    auto request = std::make_shared<typename ActionT::Impl::SendGoalService::Request>();
    request->goal_id.uuid = ClientBase::generate_goal_id();
    request->goal = goal;
    return this->send_goal(request, request->goal_id.uuid, options);
  }

 private:
  std::shared_ptr<void> create_goal_response() const override {
    return std::make_shared<typename ActionT::Impl::SendGoalService::Response>();
  }
  std::shared_ptr<void> create_result_response() const override {
    return std::make_shared<typename ActionT::Impl::GetResultService::Response>();
  }
  std::shared_ptr<void> create_feedback_message() const override {
    return std::make_shared<typename ActionT::Impl::FeedbackMessage>();
  }

  bool is_accepted(const void* untyped, builtin_interfaces::msg::Time& stamp) const override {
    const auto* const response = static_cast<const typename ActionT::Impl::SendGoalService::Response*>(untyped);
    stamp = response->stamp;
    return response->accepted;
  }

  std::shared_ptr<void> create_result_request(const GoalUUID& goal_id) const override {
    auto request = std::make_shared<typename ActionT::Impl::GetResultService::Request>();
    request->goal_id.uuid = goal_id;
    return request;
  }

  WrappedResult result_in(const GoalUUID& goal_id, const std::shared_ptr<void>& untyped) const override {
    const auto response = std::static_pointer_cast<typename ActionT::Impl::GetResultService::Response>(untyped);
    return {goal_id, static_cast<ResultCode>(response->status),
            std::make_shared<typename ActionT::Result>(response->result)};
  }

  void handle_feedback_message(std::shared_ptr<void> untyped) override {
    const auto message = std::static_pointer_cast<typename ActionT::Impl::FeedbackMessage>(std::move(untyped));
    this->tell_feedback(message->goal_id.uuid, std::shared_ptr<const Feedback>(message, &message->feedback));
  }
};

}  // namespace rclcpp_action
