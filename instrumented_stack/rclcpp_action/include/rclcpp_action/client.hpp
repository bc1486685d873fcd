// SPDX-License-Identifier: Apache-2.0
// Sends goals to the server of an action. Created by create_client().
#pragma once

#include <rcl_action/action_client.h>

#include <array>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "action_msgs/msg/goal_status_array.hpp"
#include "action_msgs/srv/cancel_goal.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/logger.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/waitable.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rosidl_typesupport_cpp/action_type_support.hpp"

namespace rclcpp_action {

// The common part of all clients, and the interface of a client for executors.
class ClientBase : public rclcpp::Waitable {
 public:
  enum class EntityType : size_t { GoalClient, ResultClient, CancelClient, FeedbackSubscription, StatusSubscription };

  ~ClientBase() override;

  // Whether a server would answer a request.
  bool action_server_is_ready() const;
  // Waits until a server is ready. Returns false after `timeout`, or when the context ends. A negative timeout waits
  // forever.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_action_server(std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return wait_for_action_server_nanoseconds(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  size_t get_number_of_ready_subscriptions() override { return 2; }
  size_t get_number_of_ready_clients() override { return 3; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override;
  bool is_ready(const rcl_wait_set_t& wait_set) override;
  std::shared_ptr<void> take_data() override;
  std::shared_ptr<void> take_data_by_entity_id(size_t id) override;
  // The identifiers are those of EntityType.
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override;
  void clear_on_ready_callback() override;
  void execute(const std::shared_ptr<void>& data) override;

  // Turns introspection of the three services on or off. Each is published on the service's name and "/_service_event";
  // see rclcpp::ClientBase::configure_introspection().
  void configure_introspection(rclcpp::Clock::SharedPtr clock, const rclcpp::QoS& qos_service_event_pub,
                               rcl_service_introspection_state_t introspection_state);

 protected:
  using ResponseCallback = std::function<void(std::shared_ptr<void> response)>;

  // Throws rclcpp::exceptions::RCLError, for example for a wrong name.
  ClientBase(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, const rclcpp::Logger& logger,
             const std::string& name, const rosidl_action_type_support_t* type_support,
             const rcl_action_client_options_t& options);

  // Sends the request; the executor calls `callback` with the response.
  void send_goal_request(const std::shared_ptr<void>& request, ResponseCallback callback);
  void send_result_request(const std::shared_ptr<void>& request, ResponseCallback callback);
  void send_cancel_request(const std::shared_ptr<void>& request, ResponseCallback callback);

  // Generates a random (version 4) identity.
  static GoalUUID generate_goal_id();

  virtual std::shared_ptr<void> create_goal_response() const = 0;
  virtual std::shared_ptr<void> create_result_response() const = 0;
  virtual std::shared_ptr<void> create_cancel_response() const = 0;
  virtual std::shared_ptr<void> create_feedback_message() const = 0;
  virtual void handle_feedback_message(std::shared_ptr<void> message) = 0;
  virtual void handle_status_message(const action_msgs::msg::GoalStatusArray& message) = 0;

  const rclcpp::Logger& get_logger() const { return logger_; }

 private:
  struct Ready {
    bool feedback = false;
    bool status = false;
    bool goal_response = false;
    bool cancel_response = false;
    bool result_response = false;
  };
  using Work = std::function<void()>;  // the result of take_data()
  using Pending = std::map<int64_t, ResponseCallback>;
  using Send = rcl_ret_t (*)(const rcl_action_client_t*, const void*, int64_t*);
  using Take = rcl_ret_t (*)(const rcl_action_client_t*, rmw_request_id_t*, void*);

  void send(Send send_request, Pending& pending, const std::shared_ptr<void>& request, ResponseCallback callback);
  Work take(EntityType entity);
  Work take_response(Take take_from_rcl, Pending& pending, std::shared_ptr<void> response);
  Work take_feedback();
  Work take_status();
  bool is_taken(rcl_ret_t ret, const char* what) const;
  bool wait_for_action_server_nanoseconds(std::chrono::nanoseconds timeout);

  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  const rclcpp::Logger logger_;
  rcl_action_client_t client_;
  const rosidl_action_type_support_t* const introspected_type_;
  std::array<rclcpp::detail::OnReadyCallback, 5> on_ready_;  // index: EntityType

  std::mutex mutex_;  // guards everything below
  Ready ready_;
  rclcpp::Clock::SharedPtr introspection_clock_;  // rcl points into it
  Pending pending_goals_;
  Pending pending_results_;
  Pending pending_cancels_;
};

// All functions may be called from any thread. Callbacks run in the executor.
template <typename ActionT>
class Client : public ClientBase, public std::enable_shared_from_this<Client<ActionT>> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Client)

  using Goal = typename ActionT::Goal;
  using Feedback = typename ActionT::Feedback;
  using GoalHandle = ClientGoalHandle<ActionT>;
  using WrappedResult = typename GoalHandle::WrappedResult;
  // Gets null if the goal was rejected.
  using GoalResponseCallback = std::function<void(typename GoalHandle::SharedPtr)>;
  using FeedbackCallback = typename GoalHandle::FeedbackCallback;
  using ResultCallback = typename GoalHandle::ResultCallback;
  using CancelRequest = typename ActionT::Impl::CancelGoalService::Request;
  using CancelResponse = typename ActionT::Impl::CancelGoalService::Response;
  using CancelCallback = std::function<void(typename CancelResponse::SharedPtr)>;

  struct SendGoalOptions {
    GoalResponseCallback goal_response_callback;
    FeedbackCallback feedback_callback;
    ResultCallback result_callback;  // if set, the result is requested as soon as the goal is accepted
  };

  Client(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, const rclcpp::Logger& logger,
         const std::string& action_name,
         const rcl_action_client_options_t& options = rcl_action_client_get_default_options())
      : ClientBase(std::move(node_base), logger, action_name,
                   rosidl_typesupport_cpp::get_action_type_support_handle<ActionT>(), options) {}

  // Goals that still wait for their result get an exception.
  ~Client() override {
    const std::lock_guard lock(goals_mutex_);
    for (const auto& [uuid, weak] : goals_) {
      if (const typename GoalHandle::SharedPtr goal = weak.lock()) {
        goal->invalidate(exceptions::UnawareGoalHandleError("the client of the goal is gone"));
      }
    }
  }

  // The future gets null if the goal was rejected. Throws rclcpp::exceptions::RCLError.
  std::shared_future<typename GoalHandle::SharedPtr> async_send_goal(const Goal& goal,
                                                                     const SendGoalOptions& options = {}) {
    auto request = std::make_shared<typename ActionT::Impl::SendGoalService::Request>();
    request->goal_id.uuid = generate_goal_id();
    request->goal = goal;
    auto promise = std::make_shared<std::promise<typename GoalHandle::SharedPtr>>();
    std::shared_future<typename GoalHandle::SharedPtr> future(promise->get_future());
    // A pending response belongs to the client, so it cannot outlive it.
    send_goal_request(request, [this, id = request->goal_id, options, promise](std::shared_ptr<void> message) {
      const auto response =
          std::static_pointer_cast<typename ActionT::Impl::SendGoalService::Response>(std::move(message));
      typename GoalHandle::SharedPtr handle;
      if (response->accepted) {
        GoalInfo info;
        info.goal_id = id;
        info.stamp = response->stamp;
        handle.reset(new GoalHandle(info, options.feedback_callback, options.result_callback));
        const std::lock_guard lock(goals_mutex_);
        goals_[id.uuid] = handle;
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

  // Throws exceptions::UnknownGoalHandleError if the goal belongs to another client or its result has come.
  std::shared_future<WrappedResult> async_get_result(typename GoalHandle::SharedPtr goal_handle,
                                                     ResultCallback result_callback = nullptr) {
    check_known(goal_handle);
    ask_for_result(goal_handle, std::move(result_callback));
    return goal_handle->result_future();
  }

  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_goal(typename GoalHandle::SharedPtr goal_handle,
                                                                           CancelCallback cancel_callback = nullptr) {
    check_known(goal_handle);
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.goal_id.uuid = goal_handle->get_goal_id();
    return cancel(std::move(request), std::move(cancel_callback));
  }

  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_all_goals(
      CancelCallback cancel_callback = nullptr) {
    return cancel(std::make_shared<CancelRequest>(), std::move(cancel_callback));
  }

  // Cancels all goals that were accepted at that time or before.
  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_goals_before(
      const rclcpp::Time& stamp, CancelCallback cancel_callback = nullptr) {
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.stamp = stamp;
    return cancel(std::move(request), std::move(cancel_callback));
  }

  // Ends all callbacks of the goal. Its result never comes.
  void stop_callbacks(typename GoalHandle::SharedPtr goal_handle) { stop_callbacks(goal_handle->get_goal_id()); }
  void stop_callbacks(const GoalUUID& goal_id) {
    typename GoalHandle::SharedPtr goal = forget(goal_id);
    if (goal) {
      goal->invalidate(exceptions::UnawareGoalHandleError("the callbacks of the goal were stopped"));
    }
  }

 private:
  std::shared_ptr<void> create_goal_response() const override {
    return std::make_shared<typename ActionT::Impl::SendGoalService::Response>();
  }
  std::shared_ptr<void> create_result_response() const override {
    return std::make_shared<typename ActionT::Impl::GetResultService::Response>();
  }
  std::shared_ptr<void> create_cancel_response() const override { return std::make_shared<CancelResponse>(); }
  std::shared_ptr<void> create_feedback_message() const override {
    return std::make_shared<typename ActionT::Impl::FeedbackMessage>();
  }

  void handle_feedback_message(std::shared_ptr<void> untyped) override {
    const auto message = std::static_pointer_cast<typename ActionT::Impl::FeedbackMessage>(std::move(untyped));
    if (const typename GoalHandle::SharedPtr goal = find(message->goal_id.uuid)) {
      goal->call_feedback_callback(goal, {message, &message->feedback});
    }
  }

  void handle_status_message(const action_msgs::msg::GoalStatusArray& message) override {
    for (const GoalStatus& status : message.status_list) {
      if (const typename GoalHandle::SharedPtr goal = find(status.goal_info.goal_id.uuid)) {
        goal->set_status(status.status);
      }
    }
  }

  void ask_for_result(const typename GoalHandle::SharedPtr& goal, ResultCallback callback) {
    if (!goal->become_result_aware(std::move(callback))) {
      return;
    }
    auto request = std::make_shared<typename ActionT::Impl::GetResultService::Request>();
    request->goal_id.uuid = goal->get_goal_id();
    send_result_request(request, [this, goal](std::shared_ptr<void> message) {
      const auto response =
          std::static_pointer_cast<typename ActionT::Impl::GetResultService::Response>(std::move(message));
      WrappedResult result;
      result.goal_id = goal->get_goal_id();
      result.code = static_cast<ResultCode>(response->status);
      result.result = std::make_shared<typename ActionT::Result>(response->result);
      if (forget(goal->get_goal_id())) {
        goal->set_result(result);
      }
    });
  }

  std::shared_future<typename CancelResponse::SharedPtr> cancel(std::shared_ptr<CancelRequest> request,
                                                                CancelCallback callback) {
    auto promise = std::make_shared<std::promise<typename CancelResponse::SharedPtr>>();
    std::shared_future<typename CancelResponse::SharedPtr> future(promise->get_future());
    send_cancel_request(request, [promise, callback = std::move(callback)](std::shared_ptr<void> message) {
      const auto response = std::static_pointer_cast<CancelResponse>(std::move(message));
      promise->set_value(response);
      if (callback) {
        callback(response);
      }
    });
    return future;
  }

  typename GoalHandle::SharedPtr find(const GoalUUID& uuid) {
    const std::lock_guard lock(goals_mutex_);
    const auto found = goals_.find(uuid);
    return found == goals_.end() ? nullptr : found->second.lock();
  }

  // Returns the goal if it was known.
  typename GoalHandle::SharedPtr forget(const GoalUUID& uuid) {
    const std::lock_guard lock(goals_mutex_);
    const auto node = goals_.extract(uuid);
    return node.empty() ? nullptr : node.mapped().lock();
  }

  void check_known(const typename GoalHandle::SharedPtr& goal) {
    if (!goal || find(goal->get_goal_id()) != goal) {
      throw exceptions::UnknownGoalHandleError();
    }
  }

  std::mutex goals_mutex_;
  // Goals are kept until the result has come. If a user drops a goal, nothing more is reported, unless its result is
  // awaited.
  std::map<GoalUUID, typename GoalHandle::WeakPtr> goals_;
};

}  // namespace rclcpp_action
