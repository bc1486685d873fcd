// SPDX-License-Identifier: Apache-2.0
// Events in general. The files of publisher and subscription initialise their own events.
#include "rmw/event.h"

#include "event/status_event.hpp"
#include "rmw/error_handling.h"
#include "types/identifier.hpp"

using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::StatusEvent;
using rmw_fastrtps::Waitable;

namespace {

StatusEvent& event_of(const rmw_event_t& handle) {
  return *static_cast<StatusEvent*>(static_cast<Waitable*>(handle.data));
}

}  // namespace

extern "C" const void* const rmw_event_callback_hands_back = &rmw_event_callback_hands_back;

rmw_event_t rmw_get_zero_initialized_event(void) {
  return {nullptr, nullptr, RMW_EVENT_INVALID};
}

bool rmw_event_type_is_supported(rmw_event_type_t rmw_event_type) {
  return rmw_event_type >= RMW_EVENT_LIVELINESS_CHANGED && rmw_event_type < RMW_EVENT_INVALID;
}

rmw_ret_t rmw_event_fini(rmw_event_t* event) {
  RMW_CHECK_HANDLE(event, RMW_RET_INVALID_ARGUMENT);
  event_of(*event).set_callback(nullptr, nullptr);
  *event = rmw_get_zero_initialized_event();
  return RMW_RET_OK;
}

rmw_ret_t rmw_take_event(const rmw_event_t* event_handle, void* event_info, bool* taken) {
  RMW_CHECK_HANDLE(event_handle, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(event_info, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  event_of(*event_handle).take(event_info);
  *taken = true;
  return RMW_RET_OK;
}

rmw_ret_t rmw_event_set_callback(rmw_event_t* event, rmw_event_callback_t callback, const void* user_data) {
  RMW_CHECK_HANDLE(event, RMW_RET_INVALID_ARGUMENT);
  event_of(*event).set_callback(callback, user_data);
  return RMW_RET_OK;
}
