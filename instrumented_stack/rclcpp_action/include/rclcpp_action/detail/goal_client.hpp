// SPDX-License-Identifier: Apache-2.0
// What clients of actions have in common, whether their type is known to the compiler or not.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "action_msgs/srv/cancel_goal.hpp"
#include "builtin_interfaces/msg/time.hpp"
#include "rclcpp_action/client_base.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rclcpp_action/exceptions.hpp"

namespace rclcpp_action::detail {

// All functions may be called from any thread. Callbacks run in the executor. A derived class tells what the messages
// of the action hold.
template <typename GoalHandleT>
class GoalClient : public ClientBase {
 public:
  using GoalHandle = GoalHandleT;
  using WrappedResult = typename GoalHandle::WrappedResult;
  // Gets null if the goal was rejected.
  using GoalResponseCallback = std::function<void(std::shared_ptr<GoalHandle>)>;
  using FeedbackCallback = typename GoalHandle::FeedbackCallback;
  using ResultCallback = typename GoalHandle::ResultCallback;
  using CancelRequest = action_msgs::srv::CancelGoal::Request;
  using CancelResponse = action_msgs::srv::CancelGoal::Response;
  using CancelCallback = std::function<void(CancelResponse::SharedPtr)>;

  struct SendGoalOptions {
    GoalResponseCallback goal_response_callback;
    FeedbackCallback feedback_callback;
    ResultCallback result_callback;  // if set, the result is requested as soon as the goal is accepted
  };

  // Goals that still wait for their result get an exception.
  ~GoalClient() override {
    const std::lock_guard lock(goals_mutex_);
    for (const auto& [uuid, weak] : goals_) {
      if (const std::shared_ptr<GoalHandle> goal = weak.lock()) {
        goal->invalidate(exceptions::UnawareGoalHandleError("the client of the goal is gone"));
      }
    }
  }

  // Throws exceptions::UnknownGoalHandleError if the goal belongs to another client or its result has come.
  std::shared_future<WrappedResult> async_get_result(std::shared_ptr<GoalHandle> goal_handle,
                                                     ResultCallback result_callback = nullptr) {
    check_known(goal_handle);
    ask_for_result(goal_handle, std::move(result_callback));
    return goal_handle->result_future();
  }

  std::shared_future<CancelResponse::SharedPtr> async_cancel_goal(std::shared_ptr<GoalHandle> goal_handle,
                                                                  CancelCallback cancel_callback = nullptr) {
    check_known(goal_handle);
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.goal_id.uuid = goal_handle->get_goal_id();
    return cancel(std::move(request), std::move(cancel_callback));
  }

  std::shared_future<CancelResponse::SharedPtr> async_cancel_all_goals(CancelCallback cancel_callback = nullptr) {
    return cancel(std::make_shared<CancelRequest>(), std::move(cancel_callback));
  }

  // Cancels all goals that were accepted at that time or before.
  std::shared_future<CancelResponse::SharedPtr> async_cancel_goals_before(const rclcpp::Time& stamp,
                                                                          CancelCallback cancel_callback = nullptr) {
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.stamp = stamp;
    return cancel(std::move(request), std::move(cancel_callback));
  }

  // Ends all callbacks of the goal. Its result never comes.
  void stop_callbacks(std::shared_ptr<GoalHandle> goal_handle) { stop_callbacks(goal_handle->get_goal_id()); }
  void stop_callbacks(const GoalUUID& goal_id) {
    if (const std::shared_ptr<GoalHandle> goal = forget(goal_id)) {
      goal->invalidate(exceptions::UnawareGoalHandleError("the callbacks of the goal were stopped"));
    }
  }

 protected:
  using ClientBase::ClientBase;

  // Of the response to a goal. False: it was rejected.
  virtual bool is_accepted(const void* response, builtin_interfaces::msg::Time& stamp) const = 0;
  // A message that asks for the result of the goal.
  virtual std::shared_ptr<void> create_result_request(const GoalUUID& goal_id) const = 0;
  virtual WrappedResult result_in(const GoalUUID& goal_id, const std::shared_ptr<void>& response) const = 0;

  // `request` is a goal with this identity. The future gets null if it was rejected.
  std::shared_future<std::shared_ptr<GoalHandle>> send_goal(const std::shared_ptr<void>& request,
                                                            const GoalUUID& goal_id, const SendGoalOptions& options) {
    auto promise = std::make_shared<std::promise<std::shared_ptr<GoalHandle>>>();
    std::shared_future<std::shared_ptr<GoalHandle>> future(promise->get_future());
    // A pending response belongs to the client, so it cannot outlive it.
    send_goal_request(request, [this, goal_id, options, promise](std::shared_ptr<void> response) {
      std::shared_ptr<GoalHandle> handle;
      GoalInfo info;
      if (is_accepted(response.get(), info.stamp)) {
        info.goal_id.uuid = goal_id;
        handle.reset(new GoalHandle(info, options.feedback_callback, options.result_callback));
        const std::lock_guard lock(goals_mutex_);
        goals_[goal_id] = handle;
      }
      promise->set_value(handle);
      if (options.goal_response_callback) {
        options.goal_response_callback(handle);
      }
      if (handle && options.result_callback) {
        ask_for_result(handle, nullptr);
      }
    });
    return future;
  }

  // Calls the callback of the goal.
  template <typename FeedbackT>
  void tell_feedback(const GoalUUID& goal_id, FeedbackT feedback) {
    if (const std::shared_ptr<GoalHandle> goal = find(goal_id)) {
      goal->call_feedback_callback(goal, std::move(feedback));
    }
  }

 private:
  std::shared_ptr<void> create_cancel_response() const override { return std::make_shared<CancelResponse>(); }

  void handle_status_message(const action_msgs::msg::GoalStatusArray& message) override {
    for (const GoalStatus& status : message.status_list) {
      if (const std::shared_ptr<GoalHandle> goal = find(status.goal_info.goal_id.uuid)) {
        goal->set_status(status.status);
      }
    }
  }

  void ask_for_result(const std::shared_ptr<GoalHandle>& goal, ResultCallback callback) {
    if (!goal->become_result_aware(std::move(callback))) {
      return;
    }
    send_result_request(create_result_request(goal->get_goal_id()), [this, goal](std::shared_ptr<void> response) {
      const WrappedResult result = result_in(goal->get_goal_id(), response);
      if (forget(goal->get_goal_id())) {
        goal->set_result(result);
      }
    });
  }

  std::shared_future<CancelResponse::SharedPtr> cancel(std::shared_ptr<CancelRequest> request,
                                                       CancelCallback callback) {
    auto promise = std::make_shared<std::promise<CancelResponse::SharedPtr>>();
    std::shared_future<CancelResponse::SharedPtr> future(promise->get_future());
    send_cancel_request(request, [promise, callback = std::move(callback)](std::shared_ptr<void> message) {
      const auto response = std::static_pointer_cast<CancelResponse>(std::move(message));
      promise->set_value(response);
      if (callback) {
        callback(response);
      }
    });
    return future;
  }

  std::shared_ptr<GoalHandle> find(const GoalUUID& uuid) {
    const std::lock_guard lock(goals_mutex_);
    const auto found = goals_.find(uuid);
    return found == goals_.end() ? nullptr : found->second.lock();
  }

  // Returns the goal if it was known.
  std::shared_ptr<GoalHandle> forget(const GoalUUID& uuid) {
    const std::lock_guard lock(goals_mutex_);
    const auto node = goals_.extract(uuid);
    return node.empty() ? nullptr : node.mapped().lock();
  }

  void check_known(const std::shared_ptr<GoalHandle>& goal) {
    if (!goal || find(goal->get_goal_id()) != goal) {
      throw exceptions::UnknownGoalHandleError();
    }
  }

  std::mutex goals_mutex_;
  // Goals are kept until the result has come. If a user drops a goal, nothing more is reported, unless its result is
  // awaited.
  std::map<GoalUUID, std::weak_ptr<GoalHandle>> goals_;
};

}  // namespace rclcpp_action::detail
