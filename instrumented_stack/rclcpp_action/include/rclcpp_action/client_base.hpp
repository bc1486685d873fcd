// SPDX-License-Identifier: Apache-2.0
// The common part of all clients of actions.
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

}  // namespace rclcpp_action
