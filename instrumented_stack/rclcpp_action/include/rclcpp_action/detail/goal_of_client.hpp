// SPDX-License-Identifier: Apache-2.0
// A goal that a server has accepted, on the side of any client.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <utility>

#include "rclcpp/time.hpp"
#include "rclcpp_action/exceptions.hpp"
#include "rclcpp_action/types.hpp"

namespace rclcpp_action::detail {

template <typename GoalHandleT>
class GoalClient;

// GoalHandleT is derived from it; callbacks get FeedbackT. All functions may be called from any thread.
template <typename GoalHandleT, typename WrappedResultT, typename FeedbackT>
class GoalOfClient {
 public:
  using FeedbackCallback = std::function<void(std::shared_ptr<GoalHandleT>, FeedbackT)>;
  using ResultCallback = std::function<void(const WrappedResultT& result)>;

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

 protected:
  GoalOfClient(const GoalInfo& info, FeedbackCallback feedback_callback, ResultCallback result_callback)
      : info_(info), feedback_callback_(std::move(feedback_callback)), result_callback_(std::move(result_callback)) {}
  ~GoalOfClient() = default;

 private:
  friend GoalClient<GoalHandleT>;

  std::shared_future<WrappedResultT> result_future() {
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

  void call_feedback_callback(const std::shared_ptr<GoalHandleT>& self, FeedbackT feedback) {
    if (feedback_callback_) {
      feedback_callback_(self, std::move(feedback));
    }
  }

  void set_status(int8_t status) {
    const std::lock_guard lock(mutex_);
    status_ = status;
  }

  void set_result(const WrappedResultT& result) {
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
  std::promise<WrappedResultT> result_promise_;
  std::shared_future<WrappedResultT> result_future_{result_promise_.get_future()};
};

}  // namespace rclcpp_action::detail
