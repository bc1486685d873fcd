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
class Client;

// All functions may be called from any thread.
template <typename ActionT>
class ClientGoalHandle {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ClientGoalHandle)

  struct WrappedResult {
    GoalUUID goal_id{};
    ResultCode code = ResultCode::UNKNOWN;
    typename ActionT::Result::SharedPtr result;
  };
  using Feedback = typename ActionT::Feedback;
  using FeedbackCallback =
      std::function<void(typename ClientGoalHandle<ActionT>::SharedPtr, const std::shared_ptr<const Feedback>)>;
  using ResultCallback = std::function<void(const WrappedResult& result)>;

  const GoalUUID& get_goal_id() const { return info_.goal_id.uuid; }
  // The time at which the server accepted the goal.
  rclcpp::Time get_goal_stamp() const { return info_.stamp; }

  // The last received status, of action_msgs/GoalStatus.
  int8_t get_status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

  // Whether feedback was requested when the goal was sent.
  bool is_feedback_aware() const { return feedback_callback_ != nullptr; }
  // Whether the result was requested.
  bool is_result_aware() const {
    const std::lock_guard lock(mutex_);
    return is_result_aware_;
  }

 private:
  friend Client<ActionT>;

  ClientGoalHandle(const GoalInfo& info, FeedbackCallback feedback_callback, ResultCallback result_callback)
      : info_(info), feedback_callback_(std::move(feedback_callback)), result_callback_(std::move(result_callback)) {}

  std::shared_future<WrappedResult> result_future() {
    const std::lock_guard lock(mutex_);
    return result_future_;
  }

  // Returns true if the result must be requested now; it then counts as requested. A new callback replaces the former
  // one.
  bool become_result_aware(ResultCallback callback) {
    const std::lock_guard lock(mutex_);
    if (callback) {
      result_callback_ = std::move(callback);
    }
    return !std::exchange(is_result_aware_, true);
  }

  void call_feedback_callback(const std::shared_ptr<ClientGoalHandle>& self, std::shared_ptr<const Feedback> feedback) {
    if (feedback_callback_) {
      feedback_callback_(self, std::move(feedback));
    }
  }

  void set_status(int8_t status) {
    const std::lock_guard lock(mutex_);
    status_ = status;
  }

  void set_result(const WrappedResult& result) {
    ResultCallback callback;
    {
      const std::lock_guard lock(mutex_);
      status_ = static_cast<int8_t>(result.code);
      result_promise_.set_value(result);
      callback = result_callback_;
    }
    if (callback) {
      callback(result);
    }
  }

  // The result will never come.
  void invalidate(const exceptions::UnawareGoalHandleError& error) {
    const std::lock_guard lock(mutex_);
    if (is_invalid_) {
      return;
    }
    is_invalid_ = true;
    status_ = GoalStatus::STATUS_UNKNOWN;
    try {
      result_promise_.set_exception(std::make_exception_ptr(error));
    } catch (const std::future_error&) {
      // The result has come already.
    }
  }

  const GoalInfo info_;
  const FeedbackCallback feedback_callback_;

  mutable std::mutex mutex_;
  ResultCallback result_callback_;
  int8_t status_ = GoalStatus::STATUS_ACCEPTED;
  bool is_result_aware_ = false;
  bool is_invalid_ = false;
  std::promise<WrappedResult> result_promise_;
  std::shared_future<WrappedResult> result_future_{result_promise_.get_future()};
};

}  // namespace rclcpp_action
