// SPDX-License-Identifier: Apache-2.0
#include "service/service_channel.hpp"

#include <algorithm>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <stdexcept>

#include "context/context_impl.hpp"
#include "context/node.hpp"
#include "fastdds_versions/writer.hpp"
#include "names/topic_name.hpp"
#include "participant/participant.hpp"
#include "process/end_of_process.hpp"
#include "qos/best_available.hpp"
#include "qos/qos.hpp"
#include "rmw/error_handling.h"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"
#include "types/dds_gid.hpp"
#include "types/message_type.hpp"

namespace rmw_fastrtps {
namespace {

// What was sent is asked about after this time, and resent if it was lost. Fast DDS would wait 3 s.
const DdsDuration kHeartbeatPeriod{0, 50'000'000};

const service_type_support_callbacks_t& service_callbacks_of(const rosidl_service_type_support_t& type_support) {
  const auto* found = rosidl_typesupport_fastrtps_cpp::find_callbacks(&type_support);
  if (found == nullptr) {
    throw std::runtime_error(std::string("the type support is of kind '") + type_support.typesupport_identifier +
                             "', but must lead to '" + rosidl_typesupport_fastrtps_cpp::typesupport_identifier + "'");
  }
  return *found;
}

}  // namespace

void ServiceChannel::open(End end, const rmw_node_t* node, const rosidl_service_type_support_t& type_support,
                          const std::string& service_name, const rmw_qos_profile_t& profile) {
  if (!profile.avoid_ros_namespace_conventions) {
    check_topic_name(service_name.c_str());
  }
  rmw_context_impl_t& context = *node->context->impl;
  participant_ = context.participant.get();
  service_name_ = service_name;
  open_endpoints(end, type_support, best_available_for_service(profile));
  try {
    enter_graph(node, {reader_identity_, writer_identity_});
  } catch (...) {
    context.graph.remove_endpoint(reader_identity_.gid);
    context.graph.remove_endpoint(writer_identity_.gid);
    close_endpoints();
    throw;
  }
}

void ServiceChannel::wait_until_received() const {
  if (process_ends()) {
    return;
  }
  (void)writer->wait_for_acknowledgments(to_dds(rmw_time_from_nsec(kPatienceAtEnd.count())));
}

void ServiceChannel::close(const rmw_node_t* node) {
  close_endpoints();
  leave_graph(node, {reader_identity_, writer_identity_});
}

void ServiceChannel::open_endpoints(End end, const rosidl_service_type_support_t& type_support,
                                    const rmw_qos_profile_t& profile) try {
  const auto& callbacks = service_callbacks_of(type_support);
  const auto& request = callbacks_of(callbacks.request_members_);
  const auto& response = callbacks_of(callbacks.response_members_);
  const bool bare = profile.avoid_ros_namespace_conventions;
  const std::string request_topic = bare ? service_name_ + "Request" : mangled_request_topic(service_name_);
  const std::string response_topic = bare ? service_name_ + "Reply" : mangled_response_topic(service_name_);
  if (end == End::kService) {
    open_reader(request_topic, request, profile);
    open_writer(response_topic, response, profile);
  } else {
    open_reader(response_topic, response, profile);
    open_writer(request_topic, request, profile);
  }
} catch (...) {
  close_endpoints();
  throw;
}

void ServiceChannel::open_reader(const std::string& topic_name, const message_type_support_callbacks_t& type,
                                 const rmw_qos_profile_t& profile) {
  fdds::DataReaderQos qos = participant_->reader_qos(topic_name, type);
  apply_profile(profile, qos);
  reader_type = &type;
  reader_topic_ = &participant_->acquire_topic(topic_name, type);
  fdds::StatusMask events = fdds::StatusMask::data_available();
  events << fdds::StatusMask::subscription_matched();
  reader = participant_->subscriber().create_datareader(reader_topic_, qos, this, events);
  if (reader == nullptr) {
    throw std::runtime_error("Fast DDS cannot create a reader on topic '" + topic_name + "'");
  }
  reader_identity_ = {to_gid(reader->guid()),
                      {GraphCache::Kind::kReader, topic_name, dds_type_name(type), profile_of(reader->get_qos())}};
}

void ServiceChannel::open_writer(const std::string& topic_name, const message_type_support_callbacks_t& type,
                                 const rmw_qos_profile_t& profile) {
  fdds::DataWriterQos qos = participant_->writer_qos(topic_name, type);
  apply_profile(profile, qos);
  heartbeat_period(qos) = std::min(heartbeat_period(qos), kHeartbeatPeriod);
  writer_type = &type;
  writer_topic_ = &participant_->acquire_topic(topic_name, type);
  writer =
      participant_->publisher().create_datawriter(writer_topic_, qos, this, fdds::StatusMask::publication_matched());
  if (writer == nullptr) {
    throw std::runtime_error("Fast DDS cannot create a writer on topic '" + topic_name + "'");
  }
  writer_identity_ = {to_gid(writer->guid()),
                      {GraphCache::Kind::kWriter, topic_name, dds_type_name(type), profile_of(writer->get_qos())}};
}

void ServiceChannel::close_endpoints() {
  if (reader != nullptr) {
    participant_->delete_reader(*reader);
    reader = nullptr;
  }
  if (reader_topic_ != nullptr) {
    participant_->release_topic(*reader_topic_);
    reader_topic_ = nullptr;
  }
  if (writer != nullptr) {
    participant_->delete_writer(*writer);
    writer = nullptr;
  }
  if (writer_topic_ != nullptr) {
    participant_->release_topic(*writer_topic_);
    writer_topic_ = nullptr;
  }
}

rmw_ret_t ServiceChannel::get_reader_qos(rmw_qos_profile_t* qos) const {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos, RMW_RET_INVALID_ARGUMENT);
  *qos = profile_of(reader->get_qos());
  return RMW_RET_OK;
}

rmw_ret_t ServiceChannel::get_writer_qos(rmw_qos_profile_t* qos) const {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos, RMW_RET_INVALID_ARGUMENT);
  *qos = profile_of(writer->get_qos());
  return RMW_RET_OK;
}

}  // namespace rmw_fastrtps
