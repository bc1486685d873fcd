// SPDX-License-Identifier: Apache-2.0
// Executes the goals of clients. Created by create_server().
#pragma once

#include <rcl_action/action_server.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "action_msgs/srv/cancel_goal.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/logger.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"
#include "rclcpp_action/server_goal_handle.hpp"
#include "rclcpp_action/types.hpp"
#include "rosidl_typesupport_cpp/action_type_support.hpp"

namespace rclcpp_action {

enum class GoalResponse : int8_t {
  REJECT = 1,
  ACCEPT_AND_EXECUTE = 2,  // starts to execute at once
  ACCEPT_AND_DEFER = 3,    // starts with ServerGoalHandle::execute()
};

enum class CancelResponse : int8_t { REJECT = 1, ACCEPT = 2 };

// The common part of all servers, and the interface of a server for executors. An executor runs one request at a time.
// The functions for goals may be called from any thread.
class ServerBase : public rclcpp::Waitable {
 public:
  enum class EntityType : size_t { GoalService, ResultService, CancelService };

  ~ServerBase() override;

  size_t get_number_of_ready_timers() override { return 1; }
  size_t get_number_of_ready_services() override { return 3; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override;
  bool is_ready(const rcl_wait_set_t& wait_set) override;
  std::shared_ptr<void> take_data() override;
  std::shared_ptr<void> take_data_by_entity_id(size_t id) override;
  // The identifiers are those of EntityType.
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override;
  void clear_on_ready_callback() override;
  void execute(const std::shared_ptr<void>& data) override;
  // A timer that forgets results after their time, for executors that do not wait for the timer of rcl.
  std::vector<std::shared_ptr<rclcpp::TimerBase>> get_timers() const override;

  // Goals that are accepted and not forgotten yet.
  int get_number_of_goal_handles() const;

  // Turns introspection of the three services on or off. Each is published on the service's name and "/_service_event";
  // see rclcpp::ServiceBase::configure_introspection().
  void configure_introspection(rclcpp::Clock::SharedPtr clock, const rclcpp::QoS& qos_service_event_pub,
                               rcl_service_introspection_state_t introspection_state);

 protected:
  // Throws rclcpp::exceptions::RCLError, for example for a wrong name.
  ServerBase(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, rclcpp::Clock::SharedPtr clock,
             const rclcpp::Logger& logger, const std::string& name, const rosidl_action_type_support_t* type_support,
             const rcl_action_server_options_t& options);

  // Functions that need the type of the action. They are called without a lock held.
  virtual std::shared_ptr<void> create_goal_request() = 0;
  virtual GoalUUID get_goal_id_from_goal_request(void* message) = 0;
  virtual GoalResponse call_handle_goal_callback(const GoalUUID& uuid, std::shared_ptr<void> goal_request) = 0;
  virtual std::shared_ptr<void> create_goal_response(bool accepted, const rcl_action_goal_info_t& info) = 0;
  virtual void call_goal_accepted_callback(std::shared_ptr<rcl_action_goal_handle_t> rcl_goal_handle,
                                           const GoalUUID& uuid, std::shared_ptr<void> goal_request) = 0;
  virtual CancelResponse call_handle_cancel_callback(const GoalUUID& uuid) = 0;
  virtual std::shared_ptr<void> create_result_request() = 0;
  virtual GoalUUID get_goal_id_from_result_request(void* message) = 0;
  virtual std::shared_ptr<void> create_result_response(int8_t status) = 0;

  void publish_status();
  void publish_feedback(const std::shared_ptr<void>& feedback_msg);
  // Ends a goal: answers the waiting requests for its result, keeps the result for later requests, and lets it expire.
  void publish_result(const GoalUUID& uuid, std::shared_ptr<void> result_response);

 private:
  struct Ready {
    bool goal = false;
    bool cancel = false;
    bool result = false;
    bool expired = false;
  };
  using Work = std::function<void()>;  // the result of take_data()
  using Take = rcl_ret_t (*)(const rcl_action_server_t*, rmw_request_id_t*, void*);
  using Answer = void (ServerBase::*)(rmw_request_id_t header, const std::shared_ptr<void>& request);

  Work take(EntityType entity);
  Work take_request(Take take_from_rcl, std::shared_ptr<void> request, Answer answer, const char* what);
  void answer_goal_request(rmw_request_id_t header, const std::shared_ptr<void>& request);
  void answer_cancel_request(rmw_request_id_t header, const std::shared_ptr<void>& request);
  void answer_result_request(rmw_request_id_t header, const std::shared_ptr<void>& request);
  void forget_expired_goals();
  // Sets the timer of get_timers() to the time of rcl's timer. The mutex must be held.
  void set_expiry() const;
  std::shared_ptr<rcl_action_goal_handle_t> accept(const GoalUUID& uuid, rcl_action_goal_info_t& info);
  void warn(rcl_ret_t ret, const char* what) const;

  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  rclcpp::Clock::SharedPtr clock_;
  const rclcpp::Logger logger_;

  std::array<rclcpp::detail::OnReadyCallback, 3> on_ready_;  // index: EntityType

  // The server of the timer of get_timers(); null when the server is being destroyed.
  struct Owner {
    std::mutex mutex;
    ServerBase* server;
  };
  const std::shared_ptr<Owner> owner_;

  mutable std::mutex mutex_;  // guards everything below, including the rcl server
  rcl_action_server_t server_;
  const rosidl_action_type_support_t* const introspected_type_;
  rclcpp::Clock::SharedPtr introspection_clock_;  // rcl points into it
  Ready ready_;
  mutable rclcpp::TimerBase::SharedPtr expiry_;                           // null until get_timers() is called
  std::map<GoalUUID, std::shared_ptr<rcl_action_goal_handle_t>> goals_;   // kept until they expire
  std::map<GoalUUID, std::shared_ptr<void>> results_;                     // of ended goals
  std::map<GoalUUID, std::vector<rmw_request_id_t>> waiting_for_result_;  // of active goals
};

template <typename ActionT>
class Server : public ServerBase, public std::enable_shared_from_this<Server<ActionT>> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Server)

  // Decides whether to accept a goal; must not block. Then the accepted goal is passed on. Long work must run in
  // another thread: otherwise the executor cannot serve cancel requests.
  using GoalCallback = std::function<GoalResponse(const GoalUUID&, std::shared_ptr<const typename ActionT::Goal>)>;
  using CancelCallback = std::function<CancelResponse(std::shared_ptr<ServerGoalHandle<ActionT>>)>;
  using AcceptedCallback = std::function<void(std::shared_ptr<ServerGoalHandle<ActionT>>)>;

  Server(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, rclcpp::Clock::SharedPtr clock,
         const rclcpp::Logger& logger, const std::string& name, const rcl_action_server_options_t& options,
         GoalCallback handle_goal, CancelCallback handle_cancel, AcceptedCallback handle_accepted)
      : ServerBase(std::move(node_base), std::move(clock), logger, name,
                   rosidl_typesupport_cpp::get_action_type_support_handle<ActionT>(), options),
        handle_goal_(std::move(handle_goal)),
        handle_cancel_(std::move(handle_cancel)),
        handle_accepted_(std::move(handle_accepted)) {}

 protected:
  using GoalRequest = typename ActionT::Impl::SendGoalService::Request;
  using ResultRequest = typename ActionT::Impl::GetResultService::Request;

  std::shared_ptr<void> create_goal_request() override { return std::make_shared<GoalRequest>(); }
  GoalUUID get_goal_id_from_goal_request(void* message) override {
    return static_cast<GoalRequest*>(message)->goal_id.uuid;
  }

  GoalResponse call_handle_goal_callback(const GoalUUID& uuid, std::shared_ptr<void> goal_request) override {
    return handle_goal_(uuid, goal_in(std::move(goal_request)));
  }

  std::shared_ptr<void> create_goal_response(bool accepted, const rcl_action_goal_info_t& info) override {
    auto response = std::make_shared<typename ActionT::Impl::SendGoalService::Response>();
    response->accepted = accepted;
    response->stamp.sec = info.stamp.sec;
    response->stamp.nanosec = info.stamp.nanosec;
    return response;
  }

  void call_goal_accepted_callback(std::shared_ptr<rcl_action_goal_handle_t> rcl_goal_handle, const GoalUUID& uuid,
                                   std::shared_ptr<void> goal_request) override {
    // A goal handle may outlive the server.
    const std::weak_ptr<Server> weak_this = this->shared_from_this();
    const auto on_terminal_state = [weak_this](const GoalUUID& ended, std::shared_ptr<void> result_response) {
      if (const auto server = weak_this.lock()) {
        server->publish_result(ended, std::move(result_response));
        server->publish_status();
        const std::lock_guard lock(server->handles_mutex_);
        server->handles_.erase(ended);
      }
    };
    const auto on_executing = [weak_this](const GoalUUID&) {
      if (const auto server = weak_this.lock()) {
        server->publish_status();
      }
    };
    const auto publish = [weak_this](std::shared_ptr<typename ActionT::Impl::FeedbackMessage> message) {
      if (const auto server = weak_this.lock()) {
        server->publish_feedback(message);
      }
    };
    const std::shared_ptr<ServerGoalHandle<ActionT>> handle(new ServerGoalHandle<ActionT>(
        std::move(rcl_goal_handle), uuid, goal_in(std::move(goal_request)), on_terminal_state, on_executing, publish));
    {
      const std::lock_guard lock(handles_mutex_);
      handles_[uuid] = handle;
    }
    handle_accepted_(handle);
  }

  CancelResponse call_handle_cancel_callback(const GoalUUID& uuid) override {
    std::shared_ptr<ServerGoalHandle<ActionT>> handle;
    {
      const std::lock_guard lock(handles_mutex_);
      if (const auto found = handles_.find(uuid); found != handles_.end()) {
        handle = found->second.lock();
      }
    }
    if (!handle) {
      return CancelResponse::REJECT;
    }
    const CancelResponse response = handle_cancel_(handle);
    if (response == CancelResponse::ACCEPT) {
      handle->_cancel_goal();
    }
    return response;
  }

  std::shared_ptr<void> create_result_request() override { return std::make_shared<ResultRequest>(); }
  GoalUUID get_goal_id_from_result_request(void* message) override {
    return static_cast<ResultRequest*>(message)->goal_id.uuid;
  }

  std::shared_ptr<void> create_result_response(int8_t status) override {
    auto response = std::make_shared<typename ActionT::Impl::GetResultService::Response>();
    response->status = status;
    return response;
  }

 private:
  static std::shared_ptr<const typename ActionT::Goal> goal_in(std::shared_ptr<void> goal_request) {
    const auto request = std::static_pointer_cast<GoalRequest>(std::move(goal_request));
    return {request, &request->goal};
  }

  GoalCallback handle_goal_;
  CancelCallback handle_cancel_;
  AcceptedCallback handle_accepted_;

  std::mutex handles_mutex_;
  std::map<GoalUUID, std::weak_ptr<ServerGoalHandle<ActionT>>> handles_;  // of active goals
};

}  // namespace rclcpp_action
