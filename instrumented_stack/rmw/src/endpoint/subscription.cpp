// SPDX-License-Identifier: Apache-2.0
// Subscriptions. Each has a DDS DataReader.
#include "endpoint/subscription.hpp"

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/ContentFilteredTopic.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <stdexcept>
#include <utility>

#include "endpoint/content_filter.hpp"
#include "endpoint/network_flow.hpp"
#include "names/topic_name.hpp"
#include "participant/participant.hpp"
#include "process/end_of_process.hpp"
#include "qos/qos.hpp"
#include "rmw/error_handling.h"
#include "tracetools/tracetools.h"
#include "types/dds_gid.hpp"
#include "types/identifier.hpp"
#include "types/message_type.hpp"

namespace fdds = eprosima::fastdds::dds;

using rmw_fastrtps::IncomingMessage;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::Loan;
using rmw_fastrtps::Participant;
using rmw_fastrtps::StatusEvent;
using rmw_fastrtps::Subscription;
using rmw_fastrtps::subscription_of;
using rmw_fastrtps::Waitable;

namespace {

[[gnu::hot]] void fill(rmw_message_info_t& message_info, const fdds::SampleInfo& sample) {
  message_info.source_timestamp = sample.source_timestamp.to_ns();
  message_info.received_timestamp = sample.reception_timestamp.to_ns();
  message_info.publication_sequence_number = sample.sample_identity.sequence_number().to64long();
  message_info.reception_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  message_info.publisher_gid.implementation_identifier = kIdentifier;
  const auto gid = rmw_fastrtps::to_gid(sample.sample_identity.writer_guid());
  std::copy(gid.begin(), gid.end(), message_info.publisher_gid.data);
  message_info.from_intra_process = false;
}

// An invalid sample announces the end of a writer's data. It is no message.
[[gnu::hot]] bool is_wanted(const rmw_subscription_t* handle, const fdds::SampleInfo& sample) {
  const bool ignored =
      handle->options.ignore_local_publications &&
      sample.sample_identity.writer_guid().guidPrefix == subscription_of(*handle).reader->guid().guidPrefix;
  return sample.valid_data && !ignored;
}

// Takes a message as the faults of the subscription want it.
[[gnu::cold]] bool take_with_faults(const rmw_subscription_t* handle, const IncomingMessage& incoming,
                                    rmw_message_info_t* message_info) {
  Subscription& subscription = subscription_of(*handle);
  const auto reader = [&](rmw_serialized_message_t& message, rmw_message_info_t& info) {
    IncomingMessage bytes{nullptr, &message, nullptr};
    fdds::SampleInfo sample;
    bool taken = false;
    while (!taken && subscription.take_next(&bytes, sample)) {
      taken = is_wanted(handle, sample);
    }
    if (taken) {
      fill(info, sample);
    }
    return taken;
  };
  rmw_message_info_t info{};
  const bool taken = subscription.faults->take(reader, incoming, info);
  if (taken && message_info != nullptr) {
    *message_info = info;
  }
  return taken;
}

[[gnu::hot]] rmw_ret_t take(const rmw_subscription_t* handle, IncomingMessage incoming,
                            [[maybe_unused]] const void* traced_message, bool* taken,
                            rmw_message_info_t* message_info) {
  Subscription& subscription = subscription_of(*handle);
  *taken = false;
  incoming.callbacks = subscription.type;
  const std::shared_lock lock(subscription.reader_mutex);
  if (subscription.faults == nullptr) {
    fdds::SampleInfo sample;
    while (!*taken && subscription.take_next(&incoming, sample)) {
      *taken = is_wanted(handle, sample);
    }
    if (*taken && message_info != nullptr) {
      fill(*message_info, sample);
    }
  } else {
    *taken = take_with_faults(handle, incoming, message_info);
  }
  TRACETOOLS_TRACEPOINT(rmw_take, static_cast<const void*>(handle), traced_message,
                        *taken && message_info != nullptr ? message_info->source_timestamp : 0, *taken);
  return RMW_RET_OK;
}

}  // namespace

namespace rmw_fastrtps {

void Subscription::on_subscription_matched(fdds::DataReader* of_reader, const fdds::SubscriptionMatchedStatus& info) {
  ReaderEvents::on_subscription_matched(of_reader, info);
  participant->graph().match_changed();
}

namespace {

void release_topics(Subscription& subscription) {
  if (subscription.filtered_topic != nullptr) {
    delete_filtered_topic(*subscription.filtered_topic);
  }
  subscription.participant->release_topic(*subscription.topic);
}

}  // namespace

void create_reader(Subscription& subscription) {
  fdds::TopicDescription* topic = subscription.topic;
  if (subscription.filtered_topic != nullptr) {
    topic = subscription.filtered_topic;
  }
  subscription.reader = subscription.participant->subscriber().create_datareader(topic, subscription.reader_qos,
                                                                                 &subscription, ReaderEvents::mask());
  const std::string& dds_topic = subscription.topic->get_name();
  if (subscription.reader == nullptr) {
    throw std::runtime_error("Fast DDS cannot create a reader on topic '" + dds_topic + "'");
  }
  subscription.identity = {
      to_gid(subscription.reader->guid()),
      {GraphCache::Kind::kReader, dds_topic, dds_type_name(*subscription.type),
       profile_of(subscription.reader->get_qos()), subscription.incompatible_type(), subscription.type->type_hash_}};
}

void trace_qos(const Subscription& subscription) {
  const TracedQos traced(subscription.identity.names.qos);
  TRACETOOLS_EXT_TRACEPOINT(rmw_subscription_qos, static_cast<const void*>(&subscription.handle), traced.reliable,
                            traced.history_depth, traced.transient_local, subscription.filtered_topic != nullptr);
}

rmw_subscription_t* create_subscription(Participant& participant, const rosidl_message_type_support_t& type_support,
                                        const std::string& topic_name, const rmw_qos_profile_t& profile,
                                        const rmw_subscription_options_t& options) {
  const auto& callbacks = callbacks_of(&type_support);
  auto subscription = std::make_unique<Subscription>();
  subscription->reader_qos = participant.reader_qos(topic_name, callbacks);
  apply_profile(profile, subscription->reader_qos);
  const std::string dds_topic = profile.avoid_ros_namespace_conventions ? topic_name : mangled_topic(topic_name);
  subscription->participant = &participant;
  subscription->type = &callbacks;
  subscription->topic = &participant.acquire_topic(dds_topic, callbacks);
  const ContentFilter filter = to_content_filter(options.content_filter_options);
  try {
    if (!filter.expression.empty()) {
      subscription->filtered_topic = &create_filtered_topic(*subscription->topic, callbacks, filter);
    }
    create_reader(*subscription);
  } catch (...) {
    release_topics(*subscription);
    throw;
  }
  subscription->topic_name = topic_name;
  rmw_subscription_options_t kept_options = options;
  kept_options.content_filter_options = nullptr;  // belongs to the caller
  subscription->handle = {
      kIdentifier,         static_cast<Waitable*>(subscription.get()), subscription->topic_name.c_str(), kept_options,
      is_plain(callbacks), subscription->filtered_topic != nullptr};
  TRACETOOLS_TRACEPOINT(rmw_subscription_init, static_cast<const void*>(&subscription->handle),
                        subscription->identity.gid.data());
  trace_qos(*subscription);
  return &subscription.release()->handle;
}

void destroy_subscription(rmw_subscription_t* handle) {
  TRACETOOLS_EXT_TRACEPOINT(rmw_subscription_fini, static_cast<const void*>(handle));
  const std::unique_ptr<Subscription> subscription(&subscription_of(*handle));
  subscription->faults.reset();
  if (!process_ends()) {
    for (const auto& [message, loan] : subscription->loans) {
      subscription->reader->return_loan(loan->samples, loan->infos);
    }
  }
  subscription->participant->delete_reader(*subscription->reader);
  release_topics(*subscription);
}

void set_faults(rmw_subscription_t& handle, std::unique_ptr<MessageFaults> faults) {
  Subscription& subscription = subscription_of(handle);
  subscription.faults = std::make_unique<TakeFaults<rmw_message_info_t>>(
      std::move(faults), *subscription.type, [&subscription] { subscription.announce_other_message(); });
  subscription.handle.can_loan_messages = false;
}

const EndpointIdentity& identity_of(const rmw_subscription_t& subscription) {
  return subscription_of(subscription).identity;
}

}  // namespace rmw_fastrtps

rmw_ret_t rmw_take(const rmw_subscription_t* subscription, void* ros_message, bool* taken,
                   rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  return take(subscription, {ros_message, nullptr}, ros_message, taken, nullptr);
}

[[gnu::hot]] rmw_ret_t rmw_take_with_info(const rmw_subscription_t* subscription, void* ros_message, bool* taken,
                                          rmw_message_info_t* message_info, rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(message_info, RMW_RET_INVALID_ARGUMENT);
  return take(subscription, {ros_message, nullptr}, ros_message, taken, message_info);
}

rmw_ret_t rmw_take_loaned_message_with_info(const rmw_subscription_t* subscription, void** loaned_message, bool* taken,
                                            rmw_message_info_t* message_info, rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(loaned_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(message_info, RMW_RET_INVALID_ARGUMENT);
  if (!subscription->can_loan_messages) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("messages on topic '%s' cannot be loaned: their type is not plain",
                                         subscription->topic_name);
    return RMW_RET_UNSUPPORTED;
  }
  Subscription& owner = subscription_of(*subscription);
  auto loan = std::make_unique<Loan>();
  const std::shared_lock reader_lock(owner.reader_mutex);
  *taken = false;
  *loaned_message = nullptr;
  while (!*taken && owner.take_next_loan(loan->samples, loan->infos)) {
    *taken = is_wanted(subscription, loan->infos[0]);
    if (!*taken) {
      owner.reader->return_loan(loan->samples, loan->infos);
    }
  }
  if (*taken) {
    fill(*message_info, loan->infos[0]);
    *loaned_message = loan->samples.buffer()[0];
    const std::lock_guard lock(owner.loans_mutex);
    owner.loans.emplace(*loaned_message, std::move(loan));
  }
  TRACETOOLS_TRACEPOINT(rmw_take, static_cast<const void*>(subscription), static_cast<const void*>(*loaned_message),
                        *taken ? message_info->source_timestamp : 0, *taken);
  return RMW_RET_OK;
}

rmw_ret_t rmw_return_loaned_message_from_subscription(const rmw_subscription_t* subscription, void* loaned_message) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(loaned_message, RMW_RET_INVALID_ARGUMENT);
  Subscription& owner = subscription_of(*subscription);
  const std::shared_lock reader_lock(owner.reader_mutex);
  std::unique_ptr<Loan> loan;
  {
    const std::lock_guard lock(owner.loans_mutex);
    const auto found = owner.loans.find(loaned_message);
    if (found != owner.loans.end()) {
      loan = std::move(found->second);
      owner.loans.erase(found);
    }
  }
  if (!loan || owner.reader->return_loan(loan->samples, loan->infos) != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the message was not taken from the subscription on topic '%s'",
                                         subscription->topic_name);
    return RMW_RET_INVALID_ARGUMENT;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_get_network_flow_endpoints(const rmw_subscription_t* subscription,
                                                      rcutils_allocator_t* allocator,
                                                      rmw_network_flow_endpoint_array_t* network_flow_endpoint_array) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(network_flow_endpoint_array, RMW_RET_INVALID_ARGUMENT);
  Subscription& owner = subscription_of(*subscription);
  const std::shared_lock lock(owner.reader_mutex);
  eprosima::fastdds::rtps::LocatorList locators;
  if (owner.reader->get_listening_locators(locators) != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the locators of the reader on topic '%s' cannot be told",
                                         subscription->topic_name);
    return RMW_RET_ERROR;
  }
  return rmw_fastrtps::to_endpoints(locators, allocator, *network_flow_endpoint_array);
}

rmw_ret_t rmw_take_serialized_message(const rmw_subscription_t* subscription,
                                      rmw_serialized_message_t* serialized_message, bool* taken,
                                      rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  return take(subscription, {nullptr, serialized_message}, serialized_message, taken, nullptr);
}

rmw_ret_t rmw_take_serialized_message_with_info(const rmw_subscription_t* subscription,
                                                rmw_serialized_message_t* serialized_message, bool* taken,
                                                rmw_message_info_t* message_info, rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(message_info, RMW_RET_INVALID_ARGUMENT);
  return take(subscription, {nullptr, serialized_message}, serialized_message, taken, message_info);
}

rmw_ret_t rmw_subscription_count_matched_publishers(const rmw_subscription_t* subscription, size_t* publisher_count) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(publisher_count, RMW_RET_INVALID_ARGUMENT);
  *publisher_count = subscription_of(*subscription).matched();
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_get_actual_qos(const rmw_subscription_t* subscription, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos, RMW_RET_INVALID_ARGUMENT);
  Subscription& owner = subscription_of(*subscription);
  const std::shared_lock lock(owner.reader_mutex);
  *qos = rmw_fastrtps::profile_of(owner.reader->get_qos());
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_set_on_new_message_callback(rmw_subscription_t* subscription, rmw_event_callback_t callback,
                                                       const void* user_data) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  Subscription& owner = subscription_of(*subscription);
  const std::shared_lock lock(owner.reader_mutex);
  owner.set_on_new_data(callback, user_data);
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_event_init(rmw_event_t* rmw_event, const rmw_subscription_t* subscription,
                                      rmw_event_type_t event_type) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(rmw_event, RMW_RET_INVALID_ARGUMENT);
  StatusEvent* event = subscription_of(*subscription).event(event_type);
  if (event == nullptr) {
    RMW_SET_ERROR_MSG("provided event_type is not supported for a subscription");
    return RMW_RET_UNSUPPORTED;
  }
  *rmw_event = {kIdentifier, static_cast<Waitable*>(event), event_type};
  return RMW_RET_OK;
}
