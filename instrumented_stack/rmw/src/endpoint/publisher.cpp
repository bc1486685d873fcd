// SPDX-License-Identifier: Apache-2.0
// Publishers. Each has a DDS DataWriter.
#include <time.h>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <stdexcept>
#include <utility>

#include "endpoint/endpoint.hpp"
#include "endpoint/network_flow.hpp"
#include "event/endpoint_events.hpp"
#include "fastdds_versions/writer.hpp"
#include "faults/publish_faults.hpp"
#include "names/topic_name.hpp"
#include "participant/participant.hpp"
#include "process/end_of_process.hpp"
#include "qos/qos.hpp"
#include "rmw/error_handling.h"
#include "tracetools/tracetools.h"
#include "types/dds_gid.hpp"
#include "types/identifier.hpp"
#include "types/message_type.hpp"

namespace fdds = rmw_fastrtps::fdds;
namespace rtps = rmw_fastrtps::rtps;

using rmw_fastrtps::EndpointIdentity;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::OutgoingMessage;
using rmw_fastrtps::Participant;
using rmw_fastrtps::PublishFaults;
using rmw_fastrtps::StatusEvent;
using rmw_fastrtps::Waitable;
using rmw_fastrtps::WriterEvents;

namespace {

struct Publisher final : WriterEvents {
  void on_publication_matched(fdds::DataWriter* of_writer, const fdds::PublicationMatchedStatus& info) override {
    WriterEvents::on_publication_matched(of_writer, info);
    participant->graph().match_changed();
  }

  rmw_publisher_t handle{};
  fdds::DataWriter* writer = nullptr;
  std::unique_ptr<PublishFaults> faults;  // of a test; null: none
  std::string topic_name;                 // the handle points to it
  Participant* participant = nullptr;
  const message_type_support_callbacks_t* type = nullptr;
  fdds::Topic* topic = nullptr;
  EndpointIdentity identity{};
};

Publisher& publisher_of(const rmw_publisher_t& handle) {
  return *static_cast<Publisher*>(handle.data);
}

// `data` is passed to the writer: an OutgoingMessage, or a loan.
[[gnu::hot]] rmw_ret_t write(const rmw_publisher_t* publisher, void* data,
                             [[maybe_unused]] const void* traced_message) {
  timespec now{};
  (void)clock_gettime(CLOCK_REALTIME, &now);
  rtps::WriteParams params;
  params.source_timestamp().seconds(static_cast<std::int32_t>(now.tv_sec));
  params.source_timestamp().nanosec(static_cast<std::uint32_t>(now.tv_nsec));
  TRACETOOLS_TRACEPOINT(rmw_publish, static_cast<const void*>(publisher), traced_message,
                        now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec);
  const Publisher& owner = publisher_of(*publisher);
  if (rmw_fastrtps::process_ends()) [[unlikely]] {
    return RMW_RET_OK;  // others have been told that this participant is gone
  }
  bool is_written = false;
  if (owner.faults == nullptr) [[likely]] {
    is_written = rmw_fastrtps::write_sample(*owner.writer, data, params);
  } else {
    is_written = owner.faults->write(*static_cast<OutgoingMessage*>(data), params);  // then nothing is on loan
  }
  if (!is_written) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("a message on topic '%s' cannot be written", publisher->topic_name);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

}  // namespace

namespace rmw_fastrtps {

rmw_publisher_t* create_publisher(Participant& participant, const rosidl_message_type_support_t& type_support,
                                  const std::string& topic_name, const rmw_qos_profile_t& profile,
                                  const rmw_publisher_options_t& options, Heartbeats heartbeats) {
  const auto& callbacks = callbacks_of(&type_support);
  fdds::DataWriterQos qos = participant.writer_qos(topic_name, callbacks);
  apply_profile(profile, qos);
  qos.reliable_writer_qos().disable_heartbeat_piggyback |= heartbeats == Heartbeats::kPeriodic;

  auto publisher = std::make_unique<Publisher>();
  const std::string dds_topic = profile.avoid_ros_namespace_conventions ? topic_name : mangled_topic(topic_name);
  publisher->participant = &participant;
  publisher->type = &callbacks;
  publisher->topic = &participant.acquire_topic(dds_topic, callbacks);
  publisher->writer =
      participant.publisher().create_datawriter(publisher->topic, qos, publisher.get(), WriterEvents::mask());
  if (publisher->writer == nullptr) {
    participant.release_topic(*publisher->topic);
    throw std::runtime_error("Fast DDS cannot create a writer on topic '" + dds_topic + "'");
  }
  publisher->identity = {
      to_gid(publisher->writer->guid()),
      {GraphCache::Kind::kWriter, dds_topic, dds_type_name(callbacks), profile_of(publisher->writer->get_qos()),
       publisher->incompatible_type(), callbacks.type_hash_}};
  publisher->topic_name = topic_name;
  publisher->handle = {kIdentifier, publisher.get(), publisher->topic_name.c_str(), options, is_plain(callbacks)};
  TRACETOOLS_TRACEPOINT(rmw_publisher_init, static_cast<const void*>(&publisher->handle),
                        publisher->identity.gid.data());
  const TracedQos traced(publisher->identity.names.qos);
  TRACETOOLS_EXT_TRACEPOINT(rmw_publisher_qos, static_cast<const void*>(&publisher->handle), traced.reliable,
                            traced.history_depth, traced.transient_local);
  return &publisher.release()->handle;
}

void destroy_publisher(rmw_publisher_t* handle) {
  TRACETOOLS_EXT_TRACEPOINT(rmw_publisher_fini, static_cast<const void*>(handle));
  const std::unique_ptr<Publisher> publisher(&publisher_of(*handle));
  publisher->faults.reset();
  publisher->participant->delete_writer(*publisher->writer);
  publisher->participant->release_topic(*publisher->topic);
}

void set_faults(rmw_publisher_t& handle, std::unique_ptr<MessageFaults> faults) {
  Publisher& publisher = publisher_of(handle);
  publisher.faults = std::make_unique<PublishFaults>(std::move(faults), *publisher.writer, *publisher.type);
  publisher.handle.can_loan_messages = false;
}

const EndpointIdentity& identity_of(const rmw_publisher_t& publisher) {
  return publisher_of(publisher).identity;
}

}  // namespace rmw_fastrtps

[[gnu::hot]] rmw_ret_t rmw_publish(const rmw_publisher_t* publisher, const void* ros_message,
                                   rmw_publisher_allocation_t*) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  OutgoingMessage outgoing{ros_message, nullptr, publisher_of(*publisher).type};
  return write(publisher, &outgoing, ros_message);
}

rmw_ret_t rmw_publish_serialized_message(const rmw_publisher_t* publisher,
                                         const rmw_serialized_message_t* serialized_message,
                                         rmw_publisher_allocation_t*) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RMW_RET_INVALID_ARGUMENT);
  OutgoingMessage outgoing{nullptr, serialized_message, nullptr};
  return write(publisher, &outgoing, serialized_message);
}

rmw_ret_t rmw_borrow_loaned_message(const rmw_publisher_t* publisher, const rosidl_message_type_support_t* type_support,
                                    void** ros_message) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  if (*ros_message != nullptr) {
    RMW_SET_ERROR_MSG("a message is borrowed into a pointer that is not null");
    return RMW_RET_INVALID_ARGUMENT;
  }
  if (!publisher->can_loan_messages) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("messages on topic '%s' cannot be loaned: their type is not plain",
                                         publisher->topic_name);
    return RMW_RET_UNSUPPORTED;
  }
  if (publisher_of(*publisher).writer->loan_sample(*ros_message) != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("no message on topic '%s' can be borrowed now", publisher->topic_name);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_return_loaned_message_from_publisher(const rmw_publisher_t* publisher, void* loaned_message) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(loaned_message, RMW_RET_INVALID_ARGUMENT);
  if (publisher_of(*publisher).writer->discard_loan(loaned_message) != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the message was not borrowed from the publisher on topic '%s'",
                                         publisher->topic_name);
    return RMW_RET_INVALID_ARGUMENT;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_publish_loaned_message(const rmw_publisher_t* publisher, void* ros_message, rmw_publisher_allocation_t*) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RMW_RET_INVALID_ARGUMENT);
  if (!publisher->can_loan_messages) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("messages on topic '%s' cannot be loaned: their type is not plain",
                                         publisher->topic_name);
    return RMW_RET_UNSUPPORTED;
  }
  return write(publisher, ros_message, ros_message);
}

rmw_ret_t rmw_publisher_count_matched_subscriptions(const rmw_publisher_t* publisher, size_t* subscription_count) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(subscription_count, RMW_RET_INVALID_ARGUMENT);
  *subscription_count = publisher_of(*publisher).matched();
  return RMW_RET_OK;
}

rmw_ret_t rmw_publisher_get_actual_qos(const rmw_publisher_t* publisher, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos, RMW_RET_INVALID_ARGUMENT);
  *qos = rmw_fastrtps::profile_of(publisher_of(*publisher).writer->get_qos());
  return RMW_RET_OK;
}

rmw_ret_t rmw_publisher_assert_liveliness(const rmw_publisher_t* publisher) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  if (publisher_of(*publisher).writer->assert_liveliness() != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the liveliness of topic '%s' cannot be asserted", publisher->topic_name);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_publisher_wait_for_all_acked(const rmw_publisher_t* publisher, rmw_time_t wait_timeout) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  const auto result = publisher_of(*publisher).writer->wait_for_acknowledgments(rmw_fastrtps::to_dds(wait_timeout));
  if (result == rmw_fastrtps::return_code::kOk) {
    return RMW_RET_OK;
  }
  if (result == rmw_fastrtps::return_code::kTimeout) {
    return RMW_RET_TIMEOUT;
  }
  RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("acknowledgments on topic '%s' cannot be waited for", publisher->topic_name);
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_publisher_get_network_flow_endpoints(const rmw_publisher_t* publisher, rcutils_allocator_t* allocator,
                                                   rmw_network_flow_endpoint_array_t* network_flow_endpoint_array) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(network_flow_endpoint_array, RMW_RET_INVALID_ARGUMENT);
  eprosima::fastdds::rtps::LocatorList locators;
  if (publisher_of(*publisher).writer->get_sending_locators(locators) != rmw_fastrtps::return_code::kOk) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the locators of the writer on topic '%s' cannot be told",
                                         publisher->topic_name);
    return RMW_RET_ERROR;
  }
  return rmw_fastrtps::to_endpoints(locators, allocator, *network_flow_endpoint_array);
}

rmw_ret_t rmw_get_gid_for_publisher(const rmw_publisher_t* publisher, rmw_gid_t* gid) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(gid, RMW_RET_INVALID_ARGUMENT);
  const auto& bytes = publisher_of(*publisher).identity.gid;
  gid->implementation_identifier = kIdentifier;
  std::copy(bytes.begin(), bytes.end(), gid->data);
  return RMW_RET_OK;
}

rmw_ret_t rmw_compare_gids_equal(const rmw_gid_t* gid1, const rmw_gid_t* gid2, bool* result) {
  RMW_CHECK_HANDLE(gid1, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(gid2, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  *result = std::equal(std::begin(gid1->data), std::end(gid1->data), std::begin(gid2->data));
  return RMW_RET_OK;
}

rmw_ret_t rmw_publisher_event_init(rmw_event_t* rmw_event, const rmw_publisher_t* publisher,
                                   rmw_event_type_t event_type) {
  RMW_CHECK_HANDLE(publisher, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(rmw_event, RMW_RET_INVALID_ARGUMENT);
  StatusEvent* event = publisher_of(*publisher).event(event_type);
  if (event == nullptr) {
    RMW_SET_ERROR_MSG("provided event_type is not supported for a publisher");
    return RMW_RET_UNSUPPORTED;
  }
  *rmw_event = {kIdentifier, static_cast<Waitable*>(event), event_type};
  return RMW_RET_OK;
}
