// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/event_handler.hpp"

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

UnsupportedEventTypeException::UnsupportedEventTypeException(rcl_ret_t result, const rcl_error_state_t* error_state,
                                                             const std::string& prefix)
    : exceptions::RCLErrorBase(result, error_state),
      std::runtime_error(prefix + (prefix.empty() ? "" : ": ") + formatted_message) {}

EventHandlerBase::EventHandlerBase(std::shared_ptr<const void> parent,
                                   const std::function<rcl_ret_t(rcl_event_t*)>& init) {
  auto event = std::make_unique<rcl_event_t>(rcl_get_zero_initialized_event());
  const rcl_ret_t ret = init(event.get());
  if (ret == RCL_RET_UNSUPPORTED) {
    const rcl_error_state_t* state = rcl_get_error_state();
    UnsupportedEventTypeException unsupported(ret, state, "Failed to initialize event");
    rcl_reset_error();
    throw unsupported;
  }
  require_ok(ret, "Failed to initialize event");
  event_handle_.reset(event.release(), [parent = std::move(parent)](rcl_event_t* handle) {
    detail::log_error(rcl_event_fini(handle), "failed to finalize an event");
    delete handle;
  });
}

EventHandlerBase::~EventHandlerBase() {
  EventHandlerBase::clear_on_ready_callback();
}

void EventHandlerBase::add_to_wait_set(rcl_wait_set_t& wait_set) {
  require_ok(rcl_wait_set_add_event(&wait_set, event_handle_.get(), &wait_set_event_index_),
             "Couldn't add event to wait set");
}

bool EventHandlerBase::is_ready(const rcl_wait_set_t& wait_set) {
  return wait_set.events[wait_set_event_index_] == event_handle_.get();
}

void EventHandlerBase::set_on_ready_callback(std::function<void(size_t, int)> callback) {
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_ready_callback is not callable.");
  }
  on_ready_.set(
      [callback = std::move(callback)](size_t count) { callback(count, static_cast<int>(EntityType::Event)); },
      "set_on_ready_callback", "event",
      [this](rcl_event_callback_t function, const void* user_data) {
        require_ok(rcl_event_set_callback(event_handle_.get(), function, user_data),
                   "failed to set the on new message callback for an event");
      });
}

void EventHandlerBase::clear_on_ready_callback() {
  on_ready_.clear([this](rcl_event_callback_t function, const void* user_data) {
    detail::ignore_error(rcl_event_set_callback(event_handle_.get(), function, user_data));
  });
}

bool EventHandlerBase::take_event(void* info) {
  if (rcl_take_event(event_handle_.get(), info) == RCL_RET_OK) {
    return true;
  }
  RCLCPP_ERROR(get_logger("rclcpp"), "Couldn't take event info: %s", rcl_get_error_string().str);
  rcl_reset_error();
  return false;
}

}  // namespace rclcpp
