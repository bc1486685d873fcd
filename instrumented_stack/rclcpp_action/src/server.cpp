// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_action/server.hpp"

#include <rcl_action/wait.h>

#include <chrono>
#include <type_traits>
#include <utility>

#include "action_msgs/msg/goal_status_array.hpp"
#include "action_msgs/srv/cancel_goal.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp_action {

using action_msgs::srv::CancelGoal;
using rclcpp::detail::require_ok;

namespace {

// Index: EntityType.
constexpr rcl_ret_t (*kSetServerCallback[])(const rcl_action_server_t*, rcl_event_callback_t, const void*) = {
    rcl_action_server_set_goal_service_callback, rcl_action_server_set_result_service_callback,
    rcl_action_server_set_cancel_service_callback};

GoalInfo to_message(const rcl_action_goal_info_t& info) {
  GoalInfo message;
  convert(info, &message.goal_id.uuid);
  message.stamp.sec = info.stamp.sec;
  message.stamp.nanosec = info.stamp.nanosec;
  return message;
}

rcl_action_goal_info_t to_info(const GoalInfo& message) {
  rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
  convert(message.goal_id.uuid, &info);
  info.stamp.sec = message.stamp.sec;
  info.stamp.nanosec = message.stamp.nanosec;
  return info;
}

}  // namespace

ServerBase::ServerBase(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base, rclcpp::Clock::SharedPtr clock,
                       const rclcpp::Logger& logger, const std::string& name,
                       const rosidl_action_type_support_t* type_support, const rcl_action_server_options_t& options)
    : node_base_(std::move(node_base)),
      clock_(std::move(clock)),
      logger_(logger.get_child("rclcpp_action")),
      owner_(std::make_shared<Owner>()),
      server_(rcl_action_get_zero_initialized_server()),
      introspected_type_(type_support) {
  owner_->server = this;
  const std::lock_guard clock_lock(clock_->get_clock_mutex());
  const rcl_ret_t ret = rcl_action_server_init(&server_, node_base_->get_rcl_node_handle(), clock_->get_clock_handle(),
                                               type_support, name.c_str(), &options);
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "could not create the server of action '" + name + "'");
  }
}

ServerBase::~ServerBase() {
  {
    const std::lock_guard lock(owner_->mutex);
    owner_->server = nullptr;
  }
  clear_on_ready_callback();
  const std::lock_guard lock(mutex_);
  const std::lock_guard clock_lock(clock_->get_clock_mutex());
  warn(rcl_action_server_fini(&server_, node_base_->get_rcl_node_handle()), "finalize an action server");
}

void ServerBase::add_to_wait_set(rcl_wait_set_t& wait_set) {
  const std::lock_guard lock(mutex_);
  require_ok(rcl_action_wait_set_add_action_server(&wait_set, &server_, nullptr),
             "could not wait for an action server");
}

bool ServerBase::is_ready(const rcl_wait_set_t& wait_set) {
  const std::lock_guard lock(mutex_);
  require_ok(rcl_action_server_wait_set_get_entities_ready(&wait_set, &server_, &ready_.goal, &ready_.cancel,
                                                           &ready_.result, &ready_.expired),
             "could not tell what of an action server is ready");
  return ready_.goal || ready_.cancel || ready_.result || ready_.expired;
}

std::shared_ptr<void> ServerBase::take_data() {
  const std::lock_guard lock(mutex_);
  Work work;
  if (std::exchange(ready_.goal, false)) {
    work = take(EntityType::GoalService);
  } else if (std::exchange(ready_.cancel, false)) {
    work = take(EntityType::CancelService);
  } else if (std::exchange(ready_.result, false)) {
    work = take(EntityType::ResultService);
  } else if (std::exchange(ready_.expired, false)) {
    work = [this] { forget_expired_goals(); };
  }
  return work ? std::make_shared<Work>(std::move(work)) : nullptr;
}

std::shared_ptr<void> ServerBase::take_data_by_entity_id(size_t id) {
  const std::lock_guard lock(mutex_);
  Work work = take(static_cast<EntityType>(id));
  return work ? std::make_shared<Work>(std::move(work)) : nullptr;
}

void ServerBase::set_on_ready_callback(std::function<void(size_t, int)> callback) {
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_ready_callback is not callable.");
  }
  for (std::size_t id = 0; id < on_ready_.size(); ++id) {
    on_ready_[id].set([callback, id](size_t count) { callback(count, static_cast<int>(id)); }, "set_on_ready_callback",
                      "action server",
                      [&](rcl_event_callback_t call, const void* data) {
                        require_ok(kSetServerCallback[id](&server_, call, data), "could not set a callback");
                      });
  }
}

void ServerBase::clear_on_ready_callback() {
  for (std::size_t id = 0; id < on_ready_.size(); ++id) {
    on_ready_[id].clear([&](rcl_event_callback_t call, const void* data) {
      rclcpp::detail::ignore_error(kSetServerCallback[id](&server_, call, data));
    });
  }
}

int ServerBase::get_number_of_goal_handles() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(goals_.size());
}

void ServerBase::execute(const std::shared_ptr<void>& data) {
  if (data) {
    (*std::static_pointer_cast<Work>(data))();
  }
}

ServerBase::Work ServerBase::take(EntityType entity) {
  switch (entity) {
    case EntityType::GoalService:
      return take_request(rcl_action_take_goal_request, create_goal_request(), &ServerBase::answer_goal_request,
                          "failed to take a goal request");
    case EntityType::ResultService:
      return take_request(rcl_action_take_result_request, create_result_request(), &ServerBase::answer_result_request,
                          "failed to take a result request");
    case EntityType::CancelService:
      return take_request(rcl_action_take_cancel_request, std::make_shared<CancelGoal::Request>(),
                          &ServerBase::answer_cancel_request, "failed to take a cancel request");
  }
  return nullptr;
}

ServerBase::Work ServerBase::take_request(Take take_from_rcl, std::shared_ptr<void> request, Answer answer,
                                          const char* what) {
  rmw_request_id_t header{};
  const rcl_ret_t ret = take_from_rcl(&server_, &header, request.get());
  if (ret == RCL_RET_ACTION_SERVER_TAKE_FAILED) {  // another thread took it
    rcl_reset_error();
    return nullptr;
  }
  require_ok(ret, what);
  return [this, answer, header, request = std::move(request)] { (this->*answer)(header, request); };
}

void ServerBase::answer_goal_request(rmw_request_id_t header, const std::shared_ptr<void>& request) {
  forget_expired_goals();  // for executors that do not wait for the timer
  const GoalUUID uuid = get_goal_id_from_goal_request(request.get());
  rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
  convert(uuid, &info);
  {
    const std::lock_guard lock(mutex_);
    if (rcl_action_server_goal_exists(&server_, &info)) {
      RCLCPP_WARN(logger_, "rejected goal %s: there is one of this id already", to_string(uuid).c_str());
      const std::shared_ptr<void> response = create_goal_response(false, info);
      warn(rcl_action_send_goal_response(&server_, &header, response.get()), "send a goal response");
      return;
    }
  }
  const GoalResponse answer = call_handle_goal_callback(uuid, request);
  std::shared_ptr<rcl_action_goal_handle_t> goal;
  if (answer != GoalResponse::REJECT) {
    goal = accept(uuid, info);
    if (answer == GoalResponse::ACCEPT_AND_EXECUTE) {
      require_ok(rcl_action_update_goal_state(goal.get(), GOAL_EVENT_EXECUTE), "could not begin to execute a goal");
    }
  }
  {
    const std::lock_guard lock(mutex_);
    const std::shared_ptr<void> response = create_goal_response(goal != nullptr, info);
    warn(rcl_action_send_goal_response(&server_, &header, response.get()), "send a goal response");
  }
  if (goal) {
    publish_status();
    call_goal_accepted_callback(std::move(goal), uuid, request);
  }
}

std::shared_ptr<rcl_action_goal_handle_t> ServerBase::accept(const GoalUUID& uuid, rcl_action_goal_info_t& info) {
  const std::lock_guard lock(mutex_);
  rcl_action_goal_handle_t* accepted = nullptr;
  {
    const std::lock_guard clock_lock(clock_->get_clock_mutex());
    accepted = rcl_action_accept_new_goal(&server_, &info);
  }
  if (!accepted) {
    rclcpp::exceptions::throw_from_rcl_error(RCL_RET_ERROR, "could not accept a goal");
  }
  std::shared_ptr<rcl_action_goal_handle_t> goal(new rcl_action_goal_handle_t(*accepted),
                                                 [](rcl_action_goal_handle_t* handle) {
                                                   (void)rcl_action_goal_handle_fini(handle);
                                                   delete handle;
                                                 });
  goals_[uuid] = goal;
  require_ok(rcl_action_goal_handle_get_info(accepted, &info), "could not tell when a goal was accepted");
  return goal;
}

void ServerBase::answer_cancel_request(rmw_request_id_t header, const std::shared_ptr<void>& request) {
  CancelGoal::Response response;
  std::vector<rcl_action_goal_info_t> candidates;
  {
    const std::lock_guard lock(mutex_);
    const rcl_action_cancel_request_t wanted{
        to_info(std::static_pointer_cast<CancelGoal::Request>(request)->goal_info)};
    rcl_action_cancel_response_t possible = rcl_action_get_zero_initialized_cancel_response();
    require_ok(rcl_action_process_cancel_request(&server_, &wanted, &possible), "could not process a cancel request");
    response.return_code = possible.msg.return_code;
    candidates.assign(possible.msg.goals_canceling.data,
                      possible.msg.goals_canceling.data + possible.msg.goals_canceling.size);
    (void)rcl_action_cancel_response_fini(&possible);
  }
  for (const rcl_action_goal_info_t& info : candidates) {
    GoalUUID uuid;
    convert(info, &uuid);
    try {
      if (call_handle_cancel_callback(uuid) == CancelResponse::ACCEPT) {
        response.goals_canceling.push_back(to_message(info));
      }
    } catch (const rclcpp::exceptions::RCLError& error) {
      // The goal ended in the meantime.
      RCLCPP_DEBUG(logger_, "could not cancel goal %s: %s", to_string(uuid).c_str(), error.what());
    }
  }
  if (!candidates.empty() && response.goals_canceling.empty()) {
    response.return_code = CancelGoal::Response::ERROR_REJECTED;
  }
  if (!response.goals_canceling.empty()) {
    publish_status();
  }
  const std::lock_guard lock(mutex_);
  warn(rcl_action_send_cancel_response(&server_, &header, &response), "send a cancel response");
}

void ServerBase::answer_result_request(rmw_request_id_t header, const std::shared_ptr<void>& request) {
  const GoalUUID uuid = get_goal_id_from_result_request(request.get());
  const std::lock_guard lock(mutex_);
  std::shared_ptr<void> response;
  if (const auto result = results_.find(uuid); result != results_.end()) {
    response = result->second;
  } else if (goals_.count(uuid) > 0) {
    waiting_for_result_[uuid].push_back(header);
    return;
  } else {
    response = create_result_response(GoalStatus::STATUS_UNKNOWN);
  }
  warn(rcl_action_send_result_response(&server_, &header, response.get()), "send a result response");
}

void ServerBase::publish_result(const GoalUUID& uuid, std::shared_ptr<void> result_response) {
  const std::lock_guard lock(mutex_);
  const auto goal = goals_.find(uuid);
  if (goal == goals_.end()) {
    throw std::runtime_error("Asked to publish result for goal that does not exist");
  }
  for (rmw_request_id_t& header : waiting_for_result_[uuid]) {
    warn(rcl_action_send_result_response(&server_, &header, result_response.get()), "send a result response");
  }
  waiting_for_result_.erase(uuid);
  results_[uuid] = std::move(result_response);
  const std::lock_guard clock_lock(clock_->get_clock_mutex());
  rcl_time_point_value_t now = 0;
  require_ok(rcl_clock_get_now(clock_->get_clock_handle(), &now), "could not tell when a goal came to its end");
  require_ok(rcl_action_goal_handle_set_goal_terminal_timestamp(goal->second.get(), now),
             "could not note when a goal came to its end");
  require_ok(rcl_action_notify_goal_done(&server_), "could not note the end of a goal");
  set_expiry();
}

void ServerBase::publish_status() {
  const std::lock_guard lock(mutex_);
  rcl_action_goal_handle_t** goals = nullptr;
  size_t count = 0;
  require_ok(rcl_action_server_get_goal_handles(&server_, &goals, &count), "could not list the goals of a server");
  action_msgs::msg::GoalStatusArray array;
  for (size_t i = 0; i < count; ++i) {
    rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
    rcl_action_goal_state_t state = GOAL_STATE_UNKNOWN;
    require_ok(rcl_action_goal_handle_get_info(goals[i], &info), "could not get the identity of a goal");
    require_ok(rcl_action_goal_handle_get_status(goals[i], &state), "could not get the status of a goal");
    GoalStatus status;
    status.goal_info = to_message(info);
    status.status = state;
    array.status_list.push_back(status);
  }
  require_ok(rcl_action_publish_status(&server_, &array), "could not publish the status of goals");
}

void ServerBase::publish_feedback(const std::shared_ptr<void>& feedback_msg) {
  const std::lock_guard lock(mutex_);
  require_ok(rcl_action_publish_feedback(&server_, feedback_msg.get()), "could not publish feedback");
}

void ServerBase::forget_expired_goals() {
  const std::lock_guard lock(mutex_);
  size_t count = 0;
  do {
    rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
    {
      const std::lock_guard clock_lock(clock_->get_clock_mutex());
      require_ok(rcl_action_expire_goals(&server_, &info, 1, &count), "could not expire goals");
    }
    if (count > 0) {
      GoalUUID uuid;
      convert(info, &uuid);
      RCLCPP_DEBUG(logger_, "forgot goal %s", to_string(uuid).c_str());
      results_.erase(uuid);
      waiting_for_result_.erase(uuid);
      goals_.erase(uuid);
    }
  } while (count > 0);
  set_expiry();
}

std::vector<std::shared_ptr<rclcpp::TimerBase>> ServerBase::get_timers() const {
  const std::lock_guard lock(mutex_);
  if (!expiry_) {
    const auto forget = [owner = owner_] {
      const std::lock_guard owner_lock(owner->mutex);
      if (owner->server) {
        owner->server->forget_expired_goals();
      }
    };
    expiry_ = std::make_shared<rclcpp::GenericTimer<std::decay_t<decltype(forget)>>>(
        clock_, std::chrono::hours(1), forget, node_base_->get_context(), false);
    set_expiry();
  }
  return {expiry_};
}

void ServerBase::set_expiry() const {
  if (!expiry_) {
    return;
  }
  int64_t left = 0;
  require_ok(rcl_action_server_get_time_until_expiry(&server_, &left), "could not tell when results expire");
  if (left < 0) {
    expiry_->cancel();
    return;
  }
  int64_t previous = 0;
  require_ok(rcl_timer_exchange_period(expiry_->get_timer_handle().get(), left, &previous),
             "could not set when results expire");
  expiry_->reset();
}

void ServerBase::warn(rcl_ret_t ret, const char* what) const {
  if (ret == RCL_RET_OK) {
    return;
  }
  RCLCPP_WARN(logger_, "failed to %s: %s", what, rcl_get_error_string().str);
  rcl_reset_error();
}

}  // namespace rclcpp_action
