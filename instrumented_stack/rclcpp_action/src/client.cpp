// SPDX-License-Identifier: Apache-2.0
#include <rcl/graph.h>
#include <rcl_action/wait.h>

#include <algorithm>
#include <random>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp_action/client_base.hpp"

namespace rclcpp_action {

using rclcpp::detail::require_ok;

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

// The graph guard condition wakes only one waiting thread, and none at shutdown. So check again after this time.
constexpr nanoseconds kGraphPatience = std::chrono::milliseconds(100);

// Index: EntityType.
constexpr rcl_ret_t (*kSetClientCallback[])(const rcl_action_client_t*, rcl_event_callback_t, const void*) = {
    rcl_action_client_set_goal_client_callback, rcl_action_client_set_result_client_callback,
    rcl_action_client_set_cancel_client_callback, rcl_action_client_set_feedback_subscription_callback,
    rcl_action_client_set_status_subscription_callback};

void wait_for_graph_change(const rcl_node_t& node, nanoseconds timeout) {
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  rcl_ret_t ret = rcl_wait_set_init(&wait_set, 0, 1, 0, 0, 0, 0, node.context, rcl_get_default_allocator());
  if (ret == RCL_RET_OK) {
    ret = rcl_wait_set_add_guard_condition(&wait_set, rcl_node_get_graph_guard_condition(&node), nullptr);
  }
  if (ret == RCL_RET_OK) {
    ret = rcl_wait(&wait_set, timeout.count());
  }
  (void)rcl_wait_set_fini(&wait_set);
  if (ret != RCL_RET_TIMEOUT) {
    require_ok(ret, "failed to wait for the graph");
  }
}

}  // namespace

ClientBase::ClientBase(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, const rclcpp::Logger& logger,
                       const std::string& name, const rosidl_action_type_support_t* type_support,
                       const rcl_action_client_options_t& options)
    : node_base_(std::move(node_base)),
      logger_(logger.get_child("rclcpp_action")),
      client_(rcl_action_get_zero_initialized_client()),
      introspected_type_(type_support) {
  const rcl_ret_t ret =
      rcl_action_client_init(&client_, node_base_->get_rcl_node_handle(), type_support, name.c_str(), &options);
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "could not create a client of action '" + name + "'");
  }
}

ClientBase::~ClientBase() {
  clear_on_ready_callback();
  if (rcl_action_client_fini(&client_, node_base_->get_rcl_node_handle()) != RCL_RET_OK) {
    RCLCPP_ERROR(logger_, "failed to finalize an action client: %s", rcl_get_error_string().str);
    rcl_reset_error();
  }
}

bool ClientBase::action_server_is_ready() const {
  bool is_ready = false;
  const rcl_ret_t ret = rcl_action_server_is_available(node_base_->get_rcl_node_handle(), &client_, &is_ready);
  if (ret == RCL_RET_NODE_INVALID && !node_base_->get_context()->is_valid()) {
    rcl_reset_error();
    return false;
  }
  require_ok(ret, "rcl_action_server_is_available failed");
  return is_ready;
}

bool ClientBase::wait_for_action_server_nanoseconds(nanoseconds timeout) {
  const rclcpp::Context::SharedPtr context = node_base_->get_context();
  const auto start = steady_clock::now();
  while (context->is_valid()) {
    if (action_server_is_ready()) {
      return true;
    }
    nanoseconds patience = kGraphPatience;
    if (timeout >= nanoseconds::zero()) {
      const nanoseconds left = timeout - (steady_clock::now() - start);
      if (left <= nanoseconds::zero()) {
        return false;
      }
      patience = std::min(patience, left);
    }
    wait_for_graph_change(*node_base_->get_rcl_node_handle(), patience);
  }
  return false;
}

void ClientBase::add_to_wait_set(rcl_wait_set_t& wait_set) {
  require_ok(rcl_action_wait_set_add_action_client(&wait_set, &client_, nullptr, nullptr),
             "could not wait for an action client");
}

bool ClientBase::is_ready(const rcl_wait_set_t& wait_set) {
  const std::lock_guard lock(mutex_);
  require_ok(rcl_action_client_wait_set_get_entities_ready(&wait_set, &client_, &ready_.feedback, &ready_.status,
                                                           &ready_.goal_response, &ready_.cancel_response,
                                                           &ready_.result_response),
             "could not tell what of an action client is ready");
  return ready_.feedback || ready_.status || ready_.goal_response || ready_.cancel_response || ready_.result_response;
}

std::shared_ptr<void> ClientBase::take_data() {
  const std::lock_guard lock(mutex_);
  // A goal must be known before its status and feedback are handled, and both are handled before its result.
  Work work;
  if (std::exchange(ready_.goal_response, false)) {
    work = take(EntityType::GoalClient);
  } else if (std::exchange(ready_.status, false)) {
    work = take(EntityType::StatusSubscription);
  } else if (std::exchange(ready_.feedback, false)) {
    work = take(EntityType::FeedbackSubscription);
  } else if (std::exchange(ready_.cancel_response, false)) {
    work = take(EntityType::CancelClient);
  } else if (std::exchange(ready_.result_response, false)) {
    work = take(EntityType::ResultClient);
  }
  return work ? std::make_shared<Work>(std::move(work)) : nullptr;
}

std::shared_ptr<void> ClientBase::take_data_by_entity_id(size_t id) {
  const std::lock_guard lock(mutex_);
  Work work = take(static_cast<EntityType>(id));
  return work ? std::make_shared<Work>(std::move(work)) : nullptr;
}

ClientBase::Work ClientBase::take(EntityType entity) {
  switch (entity) {
    case EntityType::GoalClient:
      return take_response(rcl_action_take_goal_response, pending_goals_, create_goal_response());
    case EntityType::ResultClient:
      return take_response(rcl_action_take_result_response, pending_results_, create_result_response());
    case EntityType::CancelClient:
      return take_response(rcl_action_take_cancel_response, pending_cancels_, create_cancel_response());
    case EntityType::FeedbackSubscription:
      return take_feedback();
    case EntityType::StatusSubscription:
      return take_status();
  }
  return nullptr;
}

void ClientBase::set_on_ready_callback(std::function<void(size_t, int)> callback) {
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_ready_callback is not callable.");
  }
  for (std::size_t id = 0; id < on_ready_.size(); ++id) {
    on_ready_[id].set([callback, id](size_t count) { callback(count, static_cast<int>(id)); }, "set_on_ready_callback",
                      "action client",
                      [&](rcl_event_callback_t call, const void* data) {
                        require_ok(kSetClientCallback[id](&client_, call, data), "could not set a callback");
                      });
  }
}

void ClientBase::clear_on_ready_callback() {
  for (std::size_t id = 0; id < on_ready_.size(); ++id) {
    on_ready_[id].clear([&](rcl_event_callback_t call, const void* data) {
      rclcpp::detail::ignore_error(kSetClientCallback[id](&client_, call, data));
    });
  }
}

void ClientBase::execute(const std::shared_ptr<void>& data) {
  if (data) {
    (*std::static_pointer_cast<Work>(data))();
  }
}

ClientBase::Work ClientBase::take_response(Take take_from_rcl, Pending& pending, std::shared_ptr<void> response) {
  rmw_request_id_t header{};
  if (!is_taken(take_from_rcl(&client_, &header, response.get()), "take a response")) {
    return nullptr;
  }
  auto node = pending.extract(header.sequence_number);
  if (node.empty()) {
    RCLCPP_DEBUG(logger_, "dropped a response to a request that is not pending");
    return nullptr;
  }
  return [callback = std::move(node.mapped()), response = std::move(response)] { callback(response); };
}

ClientBase::Work ClientBase::take_feedback() {
  std::shared_ptr<void> message = create_feedback_message();
  if (!is_taken(rcl_action_take_feedback(&client_, message.get()), "take feedback")) {
    return nullptr;
  }
  return [this, message = std::move(message)] { handle_feedback_message(message); };
}

ClientBase::Work ClientBase::take_status() {
  action_msgs::msg::GoalStatusArray message;
  if (!is_taken(rcl_action_take_status(&client_, &message), "take a status")) {
    return nullptr;
  }
  return [this, message = std::move(message)] { handle_status_message(message); };
}

bool ClientBase::is_taken(rcl_ret_t ret, const char* what) const {
  if (ret == RCL_RET_OK) {
    return true;
  }
  // Another thread took the response, or it was for another client.
  if (ret == RCL_RET_ACTION_CLIENT_TAKE_FAILED) {
    rcl_reset_error();
    return false;
  }
  rclcpp::exceptions::throw_from_rcl_error(ret, std::string("failed to ") + what);
}

void ClientBase::send(Send send_request, Pending& pending, const std::shared_ptr<void>& request,
                      ResponseCallback callback) {
  // The response may arrive before this function returns.
  const std::lock_guard lock(mutex_);
  int64_t sequence_number = 0;
  require_ok(send_request(&client_, request.get(), &sequence_number), "failed to send a request");
  pending.emplace(sequence_number, std::move(callback));
}

void ClientBase::send_goal_request(const std::shared_ptr<void>& request, ResponseCallback callback) {
  send(rcl_action_send_goal_request, pending_goals_, request, std::move(callback));
}

void ClientBase::send_result_request(const std::shared_ptr<void>& request, ResponseCallback callback) {
  send(rcl_action_send_result_request, pending_results_, request, std::move(callback));
}

void ClientBase::send_cancel_request(const std::shared_ptr<void>& request, ResponseCallback callback) {
  send(rcl_action_send_cancel_request, pending_cancels_, request, std::move(callback));
}

GoalUUID ClientBase::generate_goal_id() {
  thread_local std::mt19937_64 random{[] {
    std::random_device device;
    std::seed_seq seed{device(), device(), device(), device()};
    return std::mt19937_64(seed);
  }()};
  GoalUUID uuid;
  for (std::size_t i = 0; i < uuid.size(); i += 8) {
    const uint64_t bits = random();
    for (std::size_t byte = 0; byte < 8; ++byte) {
      uuid[i + byte] = static_cast<uint8_t>(bits >> (8 * byte));
    }
  }
  uuid[6] = (uuid[6] & 0x0f) | 0x40;
  uuid[8] = (uuid[8] & 0x3f) | 0x80;
  return uuid;
}

}  // namespace rclcpp_action
