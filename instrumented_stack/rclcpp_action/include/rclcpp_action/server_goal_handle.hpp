// SPDX-License-Identifier: Apache-2.0
// A goal that a server has accepted. The user's code reports its progress and its end here.
#pragma once

#include <rcl_action/goal_handle.h>

#include <exception>
#include <functional>
#include <memory>
#include <utility>

#include "rclcpp/macros.hpp"
#include "rclcpp_action/types.hpp"

namespace rclcpp_action {

// All functions may be called from any thread. They throw rclcpp::exceptions::RCLError if the change of state is not
// allowed.
class ServerGoalHandleBase {
 public:
  // Whether the client asked to cancel and the server agreed. Then stop the work and call canceled().
  bool is_canceling() const;
  // Whether the goal has not ended yet.
  bool is_active() const;
  bool is_executing() const;

 protected:
  explicit ServerGoalHandleBase(std::shared_ptr<rcl_action_goal_handle_t> rcl_handle)
      : rcl_handle_(std::move(rcl_handle)) {}
  virtual ~ServerGoalHandleBase();
  RCLCPP_DISABLE_COPY(ServerGoalHandleBase)

  void update(rcl_action_goal_event_t event, const char* what);
  // Cancels a goal that will not be ended otherwise. Returns whether it was canceled.
  bool try_canceling() noexcept;
  static void note_untold_end(const std::exception& error);

 private:
  rcl_action_goal_state_t state() const;

  std::shared_ptr<rcl_action_goal_handle_t> rcl_handle_;
};

template <typename ActionT>
class Server;

template <typename ActionT>
class ServerGoalHandle : public ServerGoalHandleBase {
 public:
  // A goal that is dropped without an end is canceled.
  ~ServerGoalHandle() override {
    if (try_canceling()) {
      auto result = std::make_shared<typename ActionT::Impl::GetResultService::Response>();
      result->status = GoalStatus::STATUS_CANCELED;
      try {
        on_terminal_state_(uuid_, result);
      } catch (const std::exception& error) {  // after the shutdown nobody can be notified
        note_untold_end(error);
      }
    }
  }

  // Sent to every client that has the goal.
  void publish_feedback(std::shared_ptr<typename ActionT::Feedback> feedback_msg) {
    auto message = std::make_shared<typename ActionT::Impl::FeedbackMessage>();
    message->goal_id.uuid = uuid_;
    message->feedback = *feedback_msg;
    publish_feedback_(std::move(message));
  }

  // The three ends. After one of them only the destructor may be called. Goals can succeed or abort while executing or
  // canceling; they can only be canceled while canceling.
  void succeed(typename ActionT::Result::SharedPtr result_msg) {
    end(GOAL_EVENT_SUCCEED, "succeed", GoalStatus::STATUS_SUCCEEDED, *result_msg);
  }
  void abort(typename ActionT::Result::SharedPtr result_msg) {
    end(GOAL_EVENT_ABORT, "abort", GoalStatus::STATUS_ABORTED, *result_msg);
  }
  void canceled(typename ActionT::Result::SharedPtr result_msg) {
    end(GOAL_EVENT_CANCELED, "be canceled", GoalStatus::STATUS_CANCELED, *result_msg);
  }

  // Starts a goal that was accepted with ACCEPT_AND_DEFER.
  void execute() {
    update(GOAL_EVENT_EXECUTE, "begin to execute");
    on_executing_(uuid_);
  }

  const std::shared_ptr<const typename ActionT::Goal> get_goal() const { return goal_; }
  const GoalUUID& get_goal_id() const { return uuid_; }

 protected:
  friend Server<ActionT>;

  using OnTerminalState = std::function<void(const GoalUUID&, std::shared_ptr<void>)>;
  using OnExecuting = std::function<void(const GoalUUID&)>;
  using PublishFeedback = std::function<void(std::shared_ptr<typename ActionT::Impl::FeedbackMessage>)>;

  ServerGoalHandle(std::shared_ptr<rcl_action_goal_handle_t> rcl_handle, GoalUUID uuid,
                   std::shared_ptr<const typename ActionT::Goal> goal, OnTerminalState on_terminal_state,
                   OnExecuting on_executing, PublishFeedback publish_feedback)
      : ServerGoalHandleBase(std::move(rcl_handle)),
        goal_(std::move(goal)),
        uuid_(uuid),
        on_terminal_state_(std::move(on_terminal_state)),
        on_executing_(std::move(on_executing)),
        publish_feedback_(std::move(publish_feedback)) {}

  void _cancel_goal() { update(GOAL_EVENT_CANCEL_GOAL, "begin to be canceled"); }

 private:
  void end(rcl_action_goal_event_t event, const char* what, int8_t status, const typename ActionT::Result& result) {
    update(event, what);
    auto response = std::make_shared<typename ActionT::Impl::GetResultService::Response>();
    response->status = status;
    response->result = result;
    on_terminal_state_(uuid_, response);
  }

  const std::shared_ptr<const typename ActionT::Goal> goal_;
  const GoalUUID uuid_;
  OnTerminalState on_terminal_state_;
  OnExecuting on_executing_;
  PublishFeedback publish_feedback_;
};

}  // namespace rclcpp_action
