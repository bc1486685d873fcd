// SPDX-License-Identifier: Apache-2.0
// Services: the end of a service that takes requests and sends responses.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "context/context_impl.hpp"
#include "context/node.hpp"
#include "fastdds_versions/writer.hpp"
#include "faults/publish_faults.hpp"
#include "faults/take_faults.hpp"
#include "process/end_of_process.hpp"
#include "rmw/error_handling.h"
#include "service/service_channel.hpp"
#include "service/service_clients.hpp"
#include "tracetools/tracetools.h"
#include "types/dds_gid.hpp"
#include "types/identifier.hpp"
#include "types/message_type.hpp"

namespace fdds = rmw_fastrtps::fdds;
namespace rtps = rmw_fastrtps::rtps;

using rmw_fastrtps::IncomingMessage;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::OutgoingMessage;
using rmw_fastrtps::PublishFaults;
using rmw_fastrtps::ServiceChannel;
using rmw_fastrtps::ServiceClients;
using rmw_fastrtps::TakeFaults;
using rmw_fastrtps::Waitable;

namespace {

struct Service final : ServiceChannel {
  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& info) override {
    if (info.current_count_change < 0) {
      clients.writer_unmatched(rmw_fastrtps::to_gid(rtps::iHandle2GUID(info.last_publication_handle)));
    }
  }

  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    const auto client = rmw_fastrtps::to_gid(rtps::iHandle2GUID(info.last_subscription_handle));
    if (info.current_count_change > 0) {
      clients.reader_matched(client);
    } else if (info.current_count_change < 0) {
      clients.reader_unmatched(client);
    }
  }

  bool is_ready() override {
    return ServiceChannel::is_ready() || stays_ready(request_faults != nullptr && request_faults->has_message());
  }

  rmw_service_t handle{};
  ServiceClients clients;
  // Of a test; null: none.
  std::unique_ptr<TakeFaults<rmw_service_info_t>> request_faults;
  std::unique_ptr<PublishFaults> response_faults;
};

// Whether the client of a request is known by its response reader. A client of another DDS program may name none; then
// it is known by the writer of the request, and nothing tells whether its reader has been found yet. The kind of an
// entity is in the last byte of its id: readers have this bit, writers do not (RTPS 9.3.1.2).
bool names_a_reader(const rmw_fastrtps::Gid& client) {
  constexpr uint8_t kReaderBit = 0x04;
  return (rmw_fastrtps::to_guid(client).entityId.value[3] & kReaderBit) != 0;
}

// rmw_wait() takes `data` as a Waitable.
Service& service_of(const rmw_service_t& handle) {
  return *static_cast<Service*>(static_cast<Waitable*>(handle.data));
}

void set_faults(Service& service, const rmw_node_t* node) {
  using rmw_message_faults::Side;
  if (auto faults = rmw_fastrtps::faults_of(Side::kRequest, service.service_name(), node)) {
    service.request_faults = std::make_unique<TakeFaults<rmw_service_info_t>>(
        std::move(faults), *service.reader_type, [&service] { service.announce_other_message(); });
  }
  if (auto faults = rmw_fastrtps::faults_of(Side::kResponse, service.service_name(), node)) {
    service.response_faults = std::make_unique<PublishFaults>(std::move(faults), *service.writer, *service.writer_type);
  }
}

bool write(Service& service, OutgoingMessage outgoing, rtps::WriteParams params) {
  if (rmw_fastrtps::process_ends()) {
    return true;  // the client has been told that this participant is gone
  }
  return service.response_faults == nullptr ? rmw_fastrtps::write_sample(*service.writer, &outgoing, params)
                                            : service.response_faults->write(outgoing, params);
}

// Sends a response when discovery has found the reader of the client. False if it cannot be kept until then.
bool write_when_matched(Service& service, const rmw_fastrtps::Gid& client, const OutgoingMessage& outgoing,
                        const rtps::WriteParams& params) {
  std::vector<std::uint8_t> bytes = rmw_fastrtps::to_bytes(*service.writer_type, outgoing);
  return !bytes.empty() &&
         service.clients.send_when_matched(client, [&service, bytes = std::move(bytes), params]() mutable {
           rmw_serialized_message_t serialized = rmw_get_zero_initialized_serialized_message();
           serialized.buffer = bytes.data();
           serialized.buffer_length = serialized.buffer_capacity = bytes.size();
           (void)write(service, {nullptr, &serialized, nullptr}, params);
         });
}

// Takes the next request that the reader holds. False if there is none.
bool take_from_reader(Service& service, IncomingMessage incoming, rmw_service_info_t& info) {
  fdds::SampleInfo sample;
  bool taken = false;
  // An invalid sample announces the end of a client. It is no request.
  while (!taken && service.take_next(&incoming, sample)) {
    taken = sample.valid_data;
  }
  if (!taken) {
    return false;
  }
  const auto writer = rmw_fastrtps::to_gid(sample.sample_identity.writer_guid());
  const rtps::GUID_t& reader_guid = sample.related_sample_identity.writer_guid();
  // A client that names no reader of its own (it is not a ROS 2 client) is identified by its writer.
  const auto client = reader_guid == rtps::GUID_t::unknown() ? writer : rmw_fastrtps::to_gid(reader_guid);
  std::copy(client.begin(), client.end(), info.request_id.writer_guid);
  info.request_id.sequence_number = sample.sample_identity.sequence_number().to64long();
  info.source_timestamp = sample.source_timestamp.to_ns();
  info.received_timestamp = sample.reception_timestamp.to_ns();
  if (names_a_reader(client)) {
    service.clients.request_taken(client, writer);
  }
  return true;
}

}  // namespace

rmw_service_t* rmw_create_service(const rmw_node_t* node, const rosidl_service_type_support_t* type_support,
                                  const char* service_name, const rmw_qos_profile_t* qos_policies) try {
  RMW_CHECK_HANDLE(node, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos_policies, nullptr);
  std::lock_guard lock(node->context->impl->mutex);
  auto service = std::make_unique<Service>();
  service->open(ServiceChannel::End::kService, node, *type_support, service_name, *qos_policies);
  try {
    set_faults(*service, node);
  } catch (...) {
    service->close(node);
    throw;
  }
  service->handle = {kIdentifier, static_cast<Waitable*>(service.get()), service->service_name().c_str()};
  TRACETOOLS_EXT_TRACEPOINT(rmw_service_init, static_cast<const void*>(&service->handle), service->reader_gid().data());
  return &service.release()->handle;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

rmw_ret_t rmw_destroy_service(rmw_node_t* node, rmw_service_t* service) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  service_of(*service).clients.wait_until_sent(ServiceChannel::kPatienceAtEnd);
  service_of(*service).wait_until_received();
  std::lock_guard lock(node->context->impl->mutex);
  TRACETOOLS_EXT_TRACEPOINT(rmw_service_fini, static_cast<const void*>(service));
  const std::unique_ptr<Service> owned(&service_of(*service));
  owned->request_faults.reset();
  owned->response_faults.reset();
  owned->close(node);
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_take_request(const rmw_service_t* service, rmw_service_info_t* request_header, void* ros_request,
                           bool* taken) {
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_request, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  Service& owned = service_of(*service);
  const IncomingMessage incoming{ros_request, nullptr, owned.reader_type};
  if (owned.request_faults == nullptr) {
    *taken = take_from_reader(owned, incoming, *request_header);
  } else {
    const auto reader = [&](rmw_serialized_message_t& request, rmw_service_info_t& info) {
      return take_from_reader(owned, {nullptr, &request, nullptr}, info);
    };
    *taken = owned.request_faults->take(reader, incoming, *request_header);
  }
  [[maybe_unused]] const rmw_request_id_t& id = request_header->request_id;
  TRACETOOLS_TRACEPOINT(rmw_take_request, static_cast<const void*>(service), ros_request,
                        reinterpret_cast<const uint8_t*>(id.writer_guid), id.sequence_number, *taken);
  return RMW_RET_OK;
}

rmw_ret_t rmw_send_response(const rmw_service_t* service, rmw_request_id_t* request_header, void* ros_response) {
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_response, RMW_RET_INVALID_ARGUMENT);
  Service& owned = service_of(*service);
  rmw_fastrtps::Gid client;
  std::copy(std::begin(request_header->writer_guid), std::end(request_header->writer_guid), client.begin());
  const auto presence = names_a_reader(client) ? owned.clients.presence_of(client) : ServiceClients::Presence::kMatched;
  if (presence == ServiceClients::Presence::kGone) {
    return RMW_RET_OK;
  }
  rtps::WriteParams params;
  params.related_sample_identity().writer_guid() = rmw_fastrtps::to_guid(client);
  params.related_sample_identity().sequence_number() =
      rtps::SequenceNumber_t(static_cast<uint64_t>(request_header->sequence_number));
  rmw_time_point_value_t now = 0;
  (void)rcutils_system_time_now(&now);
  params.source_timestamp().from_ns(now);
  TRACETOOLS_TRACEPOINT(rmw_send_response, static_cast<const void*>(service), ros_response, client.data(),
                        request_header->sequence_number, now);
  const OutgoingMessage outgoing{ros_response, nullptr, owned.writer_type};
  if (presence == ServiceClients::Presence::kUnmatched) {
    if (!write_when_matched(owned, client, outgoing, params)) {
      RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("the client of service '%s' that a response is for cannot receive it yet",
                                           service->service_name);
      return RMW_RET_TIMEOUT;
    }
    return RMW_RET_OK;
  }
  if (!write(owned, outgoing, params)) {
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("a response of service '%s' cannot be written", service->service_name);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_service_request_subscription_get_actual_qos(const rmw_service_t* service, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  return service_of(*service).get_reader_qos(qos);
}

rmw_ret_t rmw_service_response_publisher_get_actual_qos(const rmw_service_t* service, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  return service_of(*service).get_writer_qos(qos);
}

rmw_ret_t rmw_service_set_on_new_request_callback(rmw_service_t* service, rmw_event_callback_t callback,
                                                  const void* user_data) {
  RMW_CHECK_HANDLE(service, RMW_RET_INVALID_ARGUMENT);
  service_of(*service).set_on_new_data(callback, user_data);
  return RMW_RET_OK;
}
