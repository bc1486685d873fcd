// SPDX-License-Identifier: Apache-2.0
// A goal that a server has accepted, on the client's side.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "builtin_interfaces/msg/time.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp_action/detail/goal_of_client.hpp"
#include "rclcpp_action/exceptions.hpp"
#include "rclcpp_action/types.hpp"

namespace rclcpp_action {

enum class ResultCode : int8_t {
  UNKNOWN = GoalStatus::STATUS_UNKNOWN,
  SUCCEEDED = GoalStatus::STATUS_SUCCEEDED,
  CANCELED = GoalStatus::STATUS_CANCELED,
  ABORTED = GoalStatus::STATUS_ABORTED,
};

template <typename ActionT>
class ClientGoalHandle;

namespace detail {

template <typename ActionT>
struct ResultOf {
  GoalUUID goal_id{};
  ResultCode code = ResultCode::UNKNOWN;
  typename ActionT::Result::SharedPtr result;
};

template <typename ActionT>
using GoalOf =
    GoalOfClient<ClientGoalHandle<ActionT>, ResultOf<ActionT>, std::shared_ptr<const typename ActionT::Feedback>>;

}  // namespace detail

// What a goal of an action tells: detail::GoalOfClient.
template <typename ActionT>
class ClientGoalHandle : public detail::GoalOf<ActionT> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ClientGoalHandle)

  using WrappedResult = detail::ResultOf<ActionT>;
  using Feedback = typename ActionT::Feedback;

 private:
  using Base = detail::GoalOf<ActionT>;
  using Base::Base;
};

}  // namespace rclcpp_action
