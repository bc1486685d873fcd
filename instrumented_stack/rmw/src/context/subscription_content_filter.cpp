// SPDX-License-Identifier: Apache-2.0
// Content filters that change while a subscription is in use.
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "context/context_impl.hpp"
#include "context/node.hpp"
#include "endpoint/content_filter.hpp"
#include "endpoint/subscription.hpp"
#include "participant/participant.hpp"
#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "types/identifier.hpp"

using rmw_fastrtps::ContentFilter;
using rmw_fastrtps::EndpointIdentity;
using rmw_fastrtps::Subscription;
using rmw_fastrtps::subscription_of;

namespace {

// Gives the subscription a reader on another topic. A reader cannot change its topic, filtered or not. The old reader
// goes first, as in ROS 2: with both there while messages are published, Fast DDS sometimes delivers nothing to the new
// one for ever.
void replace_reader(Subscription& subscription, eprosima::fastdds::dds::ContentFilteredTopic* filtered_topic) {
  const std::unique_lock lock(subscription.reader_mutex);
  if (!subscription.loans.empty()) {
    throw std::runtime_error("the content filter cannot change while messages are on loan");
  }
  auto* const old_filtered_topic = std::exchange(subscription.filtered_topic, filtered_topic);
  subscription.participant->delete_reader(*subscription.reader);
  try {
    rmw_fastrtps::create_reader(subscription);
  } catch (...) {
    subscription.filtered_topic = old_filtered_topic;
    rmw_fastrtps::create_reader(subscription);
    throw;
  }
  if (old_filtered_topic != nullptr) {
    rmw_fastrtps::delete_filtered_topic(*old_filtered_topic);
  }
  subscription.handle.is_cft_enabled = filtered_topic != nullptr;
  rmw_fastrtps::trace_qos(subscription);
}

void add_or_remove_filter(Subscription& subscription, const ContentFilter& filter) {
  const EndpointIdentity before = subscription.identity;
  if (filter.expression.empty()) {
    replace_reader(subscription, nullptr);
  } else {
    auto& filtered_topic = rmw_fastrtps::create_filtered_topic(*subscription.topic, *subscription.type, filter);
    try {
      replace_reader(subscription, &filtered_topic);
    } catch (...) {
      rmw_fastrtps::delete_filtered_topic(filtered_topic);
      throw;
    }
  }
  if (subscription.node != nullptr) {
    rmw_fastrtps::leave_graph(subscription.node, {before});
    rmw_fastrtps::enter_graph(subscription.node, {subscription.identity});
  }
}

}  // namespace

void rmw_fastrtps::set_node(const rmw_subscription_t& subscription, const rmw_node_t& node) {
  subscription_of(subscription).node = &node;
}

rmw_ret_t rmw_subscription_set_content_filter(rmw_subscription_t* subscription,
                                              const rmw_subscription_content_filter_options_t* options) try {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RMW_RET_INVALID_ARGUMENT);
  Subscription& owner = subscription_of(*subscription);
  const ContentFilter filter = rmw_fastrtps::to_content_filter(options);
  const std::lock_guard lock(owner.node->context->impl->mutex);
  if (owner.filtered_topic != nullptr && !filter.expression.empty()) {
    rmw_fastrtps::change_filter(*owner.filtered_topic, filter);
    return RMW_RET_OK;
  }
  if (owner.filtered_topic == nullptr && filter.expression.empty()) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the subscription on topic '%s' has no content filter that could end",
                                         subscription->topic_name);
    return RMW_RET_ERROR;
  }
  add_or_remove_filter(owner, filter);
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_subscription_get_content_filter(const rmw_subscription_t* subscription, rcutils_allocator_t* allocator,
                                              rmw_subscription_content_filter_options_t* options) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RMW_RET_INVALID_ARGUMENT);
  const Subscription& owner = subscription_of(*subscription);
  const std::lock_guard lock(owner.node->context->impl->mutex);
  if (owner.filtered_topic == nullptr) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the subscription on topic '%s' has no content filter",
                                         subscription->topic_name);
    return RMW_RET_ERROR;
  }
  const ContentFilter filter = rmw_fastrtps::filter_of(*owner.filtered_topic);
  std::vector<const char*> parameters;
  for (const std::string& parameter : filter.parameters) {
    parameters.push_back(parameter.c_str());
  }
  return rmw_subscription_content_filter_options_init(filter.expression.c_str(), parameters.size(), parameters.data(),
                                                      allocator, options);
}
