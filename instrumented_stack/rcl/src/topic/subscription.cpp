// SPDX-License-Identifier: Apache-2.0
#include "rcl/subscription.h"

#include <cstdlib>
#include <cstring>

#include "rcl/error_handling.h"
#include "rcl/node_type_cache.h"
#include "rmw/rmw.h"
#include "rmw/type_description.h"
#include "tracetools/tracetools.h"

struct rcl_subscription_impl_s {
  rmw_subscription_t* rmw_handle;
  rcl_subscription_options_t options;
  rmw_qos_profile_t actual_qos;
  const rosidl_type_description_t* type;
};

rcl_subscription_t rcl_get_zero_initialized_subscription(void) {
  return {};
}

rcl_subscription_options_t rcl_subscription_get_default_options(void) {
  const char* disable = std::getenv("ROS_DISABLE_LOANED_MESSAGES");
  return {rmw_qos_profile_default, rcl_get_default_allocator(), rmw_get_default_subscription_options(),
          disable == nullptr || std::strcmp(disable, "0") != 0};
}

namespace {

// rmw fills all of `info` when it has taken a message.
[[gnu::hot]] rcl_ret_t finish_take(rmw_ret_t result, bool taken, [[maybe_unused]] const void* message,
                                   rmw_message_info_t& info) {
  if (!taken) {
    info = rmw_get_zero_initialized_message_info();
  }
  if (result != RMW_RET_OK) {
    return result;
  }
  TRACETOOLS_TRACEPOINT(rcl_take, message);
  return taken ? RCL_RET_OK : RCL_RET_SUBSCRIPTION_TAKE_FAILED;
}

}  // namespace

rcl_ret_t rcl_subscription_init(rcl_subscription_t* subscription, const rcl_node_t* node,
                                const rosidl_message_type_support_t* type_support, const char* topic_name,
                                const rcl_subscription_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(subscription, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (subscription->impl != nullptr) {
    RCL_SET_ERROR_MSG("the subscription is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  char* resolved = nullptr;
  if (const rcl_ret_t result = rcl_node_resolve_name(node, topic_name, options->allocator, false, false, &resolved);
      result != RCL_RET_OK) {
    return result == RCL_RET_UNKNOWN_SUBSTITUTION ? RCL_RET_TOPIC_NAME_INVALID : result;
  }
  rmw_subscription_t* handle = rmw_create_subscription(rcl_node_get_rmw_handle(node), type_support, resolved,
                                                       &options->qos, &options->rmw_subscription_options);
  options->allocator.deallocate(resolved, options->allocator.state);
  if (handle == nullptr) {
    return RCL_RET_ERROR;
  }
  rmw_qos_profile_t actual_qos;
  if (const rmw_ret_t result = rmw_subscription_get_actual_qos(handle, &actual_qos); result != RMW_RET_OK) {
    (void)rmw_destroy_subscription(rcl_node_get_rmw_handle(node), handle);
    return result;
  }
  actual_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
  const rosidl_type_description_t* type = rmw_message_type_description(type_support);
  (void)rcl_node_type_cache_register_type(node, type);
  subscription->impl = new rcl_subscription_impl_s{handle, *options, actual_qos, type};
  subscription->impl->options.rmw_subscription_options.content_filter_options = nullptr;  // belongs to the caller
  TRACETOOLS_TRACEPOINT(rcl_subscription_init, static_cast<const void*>(subscription), static_cast<const void*>(node),
                        static_cast<const void*>(handle), handle->topic_name, options->qos.depth);
  return RCL_RET_OK;
}

rcl_ret_t rcl_subscription_fini(rcl_subscription_t* subscription, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(subscription, RCL_RET_SUBSCRIPTION_INVALID);
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  rmw_ret_t result = RMW_RET_OK;
  if (subscription->impl != nullptr) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_subscription_fini, static_cast<const void*>(subscription));
    (void)rcl_node_type_cache_unregister_type(node, subscription->impl->type);
    result = rmw_destroy_subscription(rcl_node_get_rmw_handle(node), subscription->impl->rmw_handle);
    delete subscription->impl;
    subscription->impl = nullptr;
  }
  return result;
}

[[gnu::hot]] rcl_ret_t rcl_take(const rcl_subscription_t* subscription, void* ros_message,
                                rmw_message_info_t* message_info, rmw_subscription_allocation_t* allocation) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RCL_RET_INVALID_ARGUMENT);
  // The rmw_take event contains the source timestamp only if the caller passes a place for it.
  rmw_message_info_t local_info;
  rmw_message_info_t* info = message_info == nullptr ? &local_info : message_info;
  bool taken = false;
  const rmw_ret_t result = rmw_take_with_info(subscription->impl->rmw_handle, ros_message, &taken, info, allocation);
  return finish_take(result, taken, ros_message, *info);
}

rcl_ret_t rcl_take_serialized_message(const rcl_subscription_t* subscription,
                                      rcl_serialized_message_t* serialized_message, rmw_message_info_t* message_info,
                                      rmw_subscription_allocation_t* allocation) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RCL_RET_INVALID_ARGUMENT);
  rmw_message_info_t local_info;
  rmw_message_info_t* info = message_info == nullptr ? &local_info : message_info;
  bool taken = false;
  const rmw_ret_t result = rmw_take_serialized_message_with_info(subscription->impl->rmw_handle, serialized_message,
                                                                 &taken, info, allocation);
  return finish_take(result, taken, serialized_message, *info);
}

rcl_ret_t rcl_take_loaned_message(const rcl_subscription_t* subscription, void** loaned_message,
                                  rmw_message_info_t* message_info, rmw_subscription_allocation_t* allocation) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(loaned_message, RCL_RET_INVALID_ARGUMENT);
  rmw_message_info_t local_info;
  rmw_message_info_t* info = message_info == nullptr ? &local_info : message_info;
  bool taken = false;
  const rmw_ret_t result =
      rmw_take_loaned_message_with_info(subscription->impl->rmw_handle, loaned_message, &taken, info, allocation);
  return finish_take(result, taken, *loaned_message, *info);
}

rcl_ret_t rcl_return_loaned_message_from_subscription(const rcl_subscription_t* subscription, void* loaned_message) {
  return rcl_subscription_is_valid(subscription)
             ? rmw_return_loaned_message_from_subscription(subscription->impl->rmw_handle, loaned_message)
             : RCL_RET_SUBSCRIPTION_INVALID;
}

const char* rcl_subscription_get_topic_name(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) ? subscription->impl->rmw_handle->topic_name : nullptr;
}

const rcl_subscription_options_t* rcl_subscription_get_options(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) ? &subscription->impl->options : nullptr;
}

rmw_subscription_t* rcl_subscription_get_rmw_handle(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) ? subscription->impl->rmw_handle : nullptr;
}

const rmw_qos_profile_t* rcl_subscription_get_actual_qos(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) ? &subscription->impl->actual_qos : nullptr;
}

rcl_ret_t rcl_subscription_get_publisher_count(const rcl_subscription_t* subscription, size_t* publisher_count) {
  return rcl_subscription_is_valid(subscription)
             ? rmw_subscription_count_matched_publishers(subscription->impl->rmw_handle, publisher_count)
             : RCL_RET_SUBSCRIPTION_INVALID;
}

[[gnu::hot]] bool rcl_subscription_is_valid(const rcl_subscription_t* subscription) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(subscription, "the subscription is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(subscription->impl, "the subscription is not initialized", return false);
  return true;
}

[[gnu::hot]] bool rcl_subscription_can_loan_messages(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) && subscription->impl->rmw_handle->can_loan_messages &&
         !subscription->impl->options.disable_loaned_message;
}

rcl_ret_t rcl_subscription_set_on_new_message_callback(const rcl_subscription_t* subscription,
                                                       rcl_event_callback_t callback, const void* user_data) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  return rmw_subscription_set_on_new_message_callback(subscription->impl->rmw_handle, callback, user_data);
}
