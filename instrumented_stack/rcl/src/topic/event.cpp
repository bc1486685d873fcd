// SPDX-License-Identifier: Apache-2.0
#include "rcl/event.h"

#include "rcl/error_handling.h"
#include "rmw/rmw.h"

struct rcl_event_impl_s {
  rmw_event_t rmw_handle = rmw_get_zero_initialized_event();
};

namespace {

rmw_event_type_t to_rmw(rcl_publisher_event_type_t type) {
  switch (type) {
    case RCL_PUBLISHER_OFFERED_DEADLINE_MISSED:
      return RMW_EVENT_OFFERED_DEADLINE_MISSED;
    case RCL_PUBLISHER_LIVELINESS_LOST:
      return RMW_EVENT_LIVELINESS_LOST;
    case RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS:
      return RMW_EVENT_OFFERED_QOS_INCOMPATIBLE;
    case RCL_PUBLISHER_INCOMPATIBLE_TYPE:
      return RMW_EVENT_PUBLISHER_INCOMPATIBLE_TYPE;
    case RCL_PUBLISHER_MATCHED:
      return RMW_EVENT_PUBLICATION_MATCHED;
  }
  return RMW_EVENT_INVALID;
}

rmw_event_type_t to_rmw(rcl_subscription_event_type_t type) {
  switch (type) {
    case RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED:
      return RMW_EVENT_REQUESTED_DEADLINE_MISSED;
    case RCL_SUBSCRIPTION_LIVELINESS_CHANGED:
      return RMW_EVENT_LIVELINESS_CHANGED;
    case RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS:
      return RMW_EVENT_REQUESTED_QOS_INCOMPATIBLE;
    case RCL_SUBSCRIPTION_MESSAGE_LOST:
      return RMW_EVENT_MESSAGE_LOST;
    case RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE:
      return RMW_EVENT_SUBSCRIPTION_INCOMPATIBLE_TYPE;
    case RCL_SUBSCRIPTION_MATCHED:
      return RMW_EVENT_SUBSCRIPTION_MATCHED;
  }
  return RMW_EVENT_INVALID;
}

// `init` fills the rmw event.
template <typename InitT>
rcl_ret_t init_event(rcl_event_t* event, InitT init) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(event, RCL_RET_EVENT_INVALID);
  if (event->impl != nullptr) {
    RCL_SET_ERROR_MSG("the event is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  rcl_event_impl_t impl;
  if (const rmw_ret_t result = init(impl.rmw_handle); result != RMW_RET_OK) {
    return result;
  }
  event->impl = new rcl_event_impl_t(impl);
  return RCL_RET_OK;
}

}  // namespace

rcl_event_t rcl_get_zero_initialized_event(void) {
  return {};
}

rcl_ret_t rcl_publisher_event_init(rcl_event_t* event, const rcl_publisher_t* publisher,
                                   rcl_publisher_event_type_t event_type) {
  if (!rcl_publisher_is_valid(publisher)) {
    return RCL_RET_PUBLISHER_INVALID;
  }
  return init_event(event, [&](rmw_event_t& handle) {
    return rmw_publisher_event_init(&handle, rcl_publisher_get_rmw_handle(publisher), to_rmw(event_type));
  });
}

rcl_ret_t rcl_subscription_event_init(rcl_event_t* event, const rcl_subscription_t* subscription,
                                      rcl_subscription_event_type_t event_type) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  return init_event(event, [&](rmw_event_t& handle) {
    return rmw_subscription_event_init(&handle, rcl_subscription_get_rmw_handle(subscription), to_rmw(event_type));
  });
}

rcl_ret_t rcl_event_fini(rcl_event_t* event) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(event, RCL_RET_INVALID_ARGUMENT);
  rmw_ret_t result = RMW_RET_OK;
  if (event->impl != nullptr) {
    result = rmw_event_fini(&event->impl->rmw_handle);
    delete event->impl;
    event->impl = nullptr;
  }
  return result;
}

rcl_ret_t rcl_take_event(const rcl_event_t* event, void* event_info) {
  if (!rcl_event_is_valid(event)) {
    return RCL_RET_EVENT_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(event_info, RCL_RET_INVALID_ARGUMENT);
  bool taken = false;
  if (const rmw_ret_t result = rmw_take_event(&event->impl->rmw_handle, event_info, &taken); result != RMW_RET_OK) {
    return result;
  }
  return taken ? RCL_RET_OK : RCL_RET_EVENT_TAKE_FAILED;
}

rmw_event_t* rcl_event_get_rmw_handle(const rcl_event_t* event) {
  return rcl_event_is_valid(event) ? &event->impl->rmw_handle : nullptr;
}

bool rcl_event_is_valid(const rcl_event_t* event) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(event, "the event is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(event->impl, "the event is not initialized", return false);
  return true;
}

rcl_ret_t rcl_event_set_callback(const rcl_event_t* event, rcl_event_callback_t callback, const void* user_data) {
  if (!rcl_event_is_valid(event)) {
    return RCL_RET_EVENT_INVALID;
  }
  return rmw_event_set_callback(&event->impl->rmw_handle, callback, user_data);
}
