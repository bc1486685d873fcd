// SPDX-License-Identifier: Apache-2.0
#include "rcl/subscription.h"

#include <cstdlib>
#include <cstring>

#include "node/node_entity.hpp"
#include "rcl/network_flow_endpoints.h"
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
  const auto create = [&](rmw_node_t* rmw_node, const char* name) {
    return rmw_create_subscription(rmw_node, type_support, name, &options->qos, &options->rmw_subscription_options);
  };
  const auto complete = [&](rcl_subscription_impl_t& impl) {
    impl.type = rmw_message_type_description(type_support);
    const rmw_ret_t result = rmw_subscription_get_actual_qos(impl.rmw_handle, &impl.actual_qos);
    impl.actual_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    return result;
  };
  if (const rcl_ret_t result = rcl::init_entity(subscription->impl, "subscription", node, rcl::NameKind::kTopic,
                                                topic_name, *options, create, complete, rmw_destroy_subscription);
      result != RCL_RET_OK) {
    return result;
  }
  subscription->impl->options.rmw_subscription_options.content_filter_options = nullptr;  // belongs to the caller
  [[maybe_unused]] const auto* handle = subscription->impl->rmw_handle;
  TRACETOOLS_TRACEPOINT(rcl_subscription_init, static_cast<const void*>(subscription), static_cast<const void*>(node),
                        static_cast<const void*>(handle), handle->topic_name, options->qos.depth);
  return RCL_RET_OK;
}

rcl_ret_t rcl_subscription_fini(rcl_subscription_t* subscription, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(subscription, RCL_RET_SUBSCRIPTION_INVALID);
  return rcl::fini_entity(subscription->impl, node, [&](rmw_node_t* rmw_node, rcl_subscription_impl_t& impl) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_subscription_fini, static_cast<const void*>(subscription));
    return rmw_destroy_subscription(rmw_node, impl.rmw_handle);
  });
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

rcl_ret_t rcl_subscription_get_network_flow_endpoints(const rcl_subscription_t* subscription,
                                                      rcutils_allocator_t* allocator,
                                                      rcl_network_flow_endpoint_array_t* network_flow_endpoint_array) {
  return rcl_subscription_is_valid(subscription)
             ? rmw_subscription_get_network_flow_endpoints(subscription->impl->rmw_handle, allocator,
                                                           network_flow_endpoint_array)
             : RCL_RET_SUBSCRIPTION_INVALID;
}
