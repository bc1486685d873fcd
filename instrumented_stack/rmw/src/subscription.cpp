// Subscriptions: a DDS DataReader each.
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <stdexcept>

#include "dds_gid.hpp"
#include "endpoint.hpp"
#include "identifier.hpp"
#include "message_type.hpp"
#include "participant.hpp"
#include "qos.hpp"
#include "reader_events.hpp"
#include "rmw/error_handling.h"
#include "topic_name.hpp"
#include "tracetools/tracetools.h"

namespace fdds = eprosima::fastdds::dds;

using rmw_fastrtps::EndpointIdentity;
using rmw_fastrtps::IncomingMessage;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::Participant;
using rmw_fastrtps::ReaderEvents;
using rmw_fastrtps::StatusEvent;
using rmw_fastrtps::Waitable;

namespace {

struct Subscription final : ReaderEvents {
  rmw_subscription_t handle{};
  std::string topic_name;  // of the handle
  Participant* participant = nullptr;
  fdds::Topic* topic = nullptr;
  EndpointIdentity identity{};
};

// rmw_wait() takes `data` as a Waitable.
Subscription& subscription_of(const rmw_subscription_t& handle) {
  return *static_cast<Subscription*>(static_cast<Waitable*>(handle.data));
}

void fill(rmw_message_info_t& message_info, const fdds::SampleInfo& sample) {
  message_info.source_timestamp = sample.source_timestamp.to_ns();
  message_info.received_timestamp = sample.reception_timestamp.to_ns();
  message_info.publication_sequence_number = sample.sample_identity.sequence_number().to64long();
  message_info.reception_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  message_info.publisher_gid.implementation_identifier = kIdentifier;
  const auto gid = rmw_fastrtps::to_gid(sample.sample_identity.writer_guid());
  std::copy(gid.begin(), gid.end(), message_info.publisher_gid.data);
  message_info.from_intra_process = false;
}

rmw_ret_t take(const rmw_subscription_t* handle, IncomingMessage incoming, const void* traced_message, bool* taken,
               rmw_message_info_t* message_info) {
  Subscription& subscription = subscription_of(*handle);
  const auto own_prefix = subscription.reader->guid().guidPrefix;
  *taken = false;
  fdds::SampleInfo sample;
  while (!*taken && subscription.take_next(&incoming, sample)) {
    // Invalid samples tell of the end of a writer's data, not of a message.
    const bool ignored =
        handle->options.ignore_local_publications && sample.sample_identity.writer_guid().guidPrefix == own_prefix;
    *taken = sample.valid_data && !ignored;
  }
  if (*taken && message_info != nullptr) {
    fill(*message_info, sample);
  }
  TRACETOOLS_TRACEPOINT(rmw_take, static_cast<const void*>(handle), traced_message,
                        *taken && message_info != nullptr ? message_info->source_timestamp : 0, *taken);
  return RMW_RET_OK;
}

}  // namespace

namespace rmw_fastrtps {

rmw_subscription_t* create_subscription(Participant& participant, const rosidl_message_type_support_t& type_support,
                                        const std::string& topic_name, const rmw_qos_profile_t& profile,
                                        const rmw_subscription_options_t& options) {
  const auto& callbacks = callbacks_of(&type_support);
  fdds::DataReaderQos qos = participant.reader_qos(topic_name, callbacks);
  apply_profile(profile, qos);

  auto subscription = std::make_unique<Subscription>();
  const std::string dds_topic = profile.avoid_ros_namespace_conventions ? topic_name : mangled_topic(topic_name);
  subscription->participant = &participant;
  subscription->topic = &participant.acquire_topic(dds_topic, callbacks);
  subscription->reader =
      participant.subscriber().create_datareader(subscription->topic, qos, subscription.get(), ReaderEvents::mask());
  if (subscription->reader == nullptr) {
    participant.release_topic(*subscription->topic);
    throw std::runtime_error("Fast DDS cannot create a reader on topic '" + dds_topic + "'");
  }
  subscription->identity = {
      to_gid(subscription->reader->guid()),
      {GraphCache::Kind::kReader, dds_topic, dds_type_name(callbacks), profile_of(subscription->reader->get_qos())}};
  subscription->topic_name = topic_name;
  subscription->handle = {
      kIdentifier, static_cast<Waitable*>(subscription.get()), subscription->topic_name.c_str(), options, false, false};
  TRACETOOLS_TRACEPOINT(rmw_subscription_init, static_cast<const void*>(&subscription->handle),
                        subscription->identity.gid.data());
  return &subscription.release()->handle;
}

void destroy_subscription(rmw_subscription_t* handle) {
  TRACETOOLS_EXT_TRACEPOINT(rmw_subscription_fini, static_cast<const void*>(handle));
  const std::unique_ptr<Subscription> subscription(&subscription_of(*handle));
  subscription->reader->set_listener(nullptr);
  subscription->participant->subscriber().delete_datareader(subscription->reader);
  subscription->participant->release_topic(*subscription->topic);
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

rmw_ret_t rmw_take_with_info(const rmw_subscription_t* subscription, void* ros_message, bool* taken,
                             rmw_message_info_t* message_info, rmw_subscription_allocation_t*) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(message_info, RMW_RET_INVALID_ARGUMENT);
  return take(subscription, {ros_message, nullptr}, ros_message, taken, message_info);
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
  *qos = rmw_fastrtps::profile_of(subscription_of(*subscription).reader->get_qos());
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_set_on_new_message_callback(rmw_subscription_t* subscription, rmw_event_callback_t callback,
                                                       const void* user_data) {
  RMW_CHECK_HANDLE(subscription, RMW_RET_INVALID_ARGUMENT);
  subscription_of(*subscription).set_on_new_data(callback, user_data);
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
