// SPDX-License-Identifier: Apache-2.0
// Clients: the end of a service that sends requests and takes responses.
#include <algorithm>
#include <atomic>
#include <memory>

#include "context/context_impl.hpp"
#include "context/node.hpp"
#include "fastdds_versions/writer.hpp"
#include "participant/participant.hpp"
#include "process/end_of_process.hpp"
#include "rmw/error_handling.h"
#include "service/service_channel.hpp"
#include "tracetools/tracetools.h"
#include "types/dds_gid.hpp"
#include "types/identifier.hpp"
#include "types/message_type.hpp"

namespace fdds = rmw_fastrtps::fdds;
namespace rtps = rmw_fastrtps::rtps;

using rmw_fastrtps::IncomingMessage;
using rmw_fastrtps::kIdentifier;
using rmw_fastrtps::OutgoingMessage;
using rmw_fastrtps::ServiceChannel;
using rmw_fastrtps::Waitable;

namespace {

struct Client final : ServiceChannel {
  void on_subscription_matched(fdds::DataReader*, const fdds::SubscriptionMatchedStatus& info) override {
    response_writers = info.current_count;
    participant().graph().match_changed();
  }

  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    request_readers = info.current_count;
    participant().graph().match_changed();
  }

  rmw_client_t handle{};
  // Matched endpoints that belong to services.
  std::atomic<int32_t> response_writers{0};
  std::atomic<int32_t> request_readers{0};
  std::atomic<int64_t> unanswered{0};  // requests
};

// rmw_wait() takes `data` as a Waitable.
Client& client_of(const rmw_client_t& handle) {
  return *static_cast<Client*>(static_cast<Waitable*>(handle.data));
}

}  // namespace

rmw_client_t* rmw_create_client(const rmw_node_t* node, const rosidl_service_type_support_t* type_support,
                                const char* service_name, const rmw_qos_profile_t* qos_policies) try {
  RMW_CHECK_HANDLE(node, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(qos_policies, nullptr);
  std::lock_guard lock(node->context->impl->mutex);
  auto client = std::make_unique<Client>();
  client->open(ServiceChannel::End::kClient, node, *type_support, service_name, *qos_policies);
  client->handle = {kIdentifier, static_cast<Waitable*>(client.get()), client->service_name().c_str()};
  TRACETOOLS_TRACEPOINT(rmw_client_init, static_cast<const void*>(&client->handle), client->reader_gid().data());
  return &client.release()->handle;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

rmw_ret_t rmw_destroy_client(rmw_node_t* node, rmw_client_t* client) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  if (client_of(*client).unanswered > 0) {  // otherwise the requests have arrived
    client_of(*client).wait_until_received();
  }
  std::lock_guard lock(node->context->impl->mutex);
  TRACETOOLS_EXT_TRACEPOINT(rmw_client_fini, static_cast<const void*>(client));
  const std::unique_ptr<Client> owned(&client_of(*client));
  owned->close(node);
  return RMW_RET_OK;
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return RMW_RET_ERROR;
}

rmw_ret_t rmw_send_request(const rmw_client_t* client, const void* ros_request, int64_t* sequence_id) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_request, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(sequence_id, RMW_RET_INVALID_ARGUMENT);
  if (rmw_fastrtps::process_ends()) {
    RMW_SET_ERROR_MSG("no request can be sent at the end of the process");
    return RMW_RET_ERROR;
  }
  Client& owned = client_of(*client);
  rtps::WriteParams params;
  params.related_sample_identity().writer_guid() = owned.reader->guid();
  OutgoingMessage outgoing{ros_request, nullptr, owned.writer_type};
  ++owned.unanswered;
  if (!rmw_fastrtps::write_sample(*owned.writer, &outgoing, params)) {
    --owned.unanswered;
    RMW_SET_ERROR_MSG_WITH_FORMAT_STRING("a request to service '%s' cannot be written", client->service_name);
    return RMW_RET_ERROR;
  }
  *sequence_id = params.sample_identity().sequence_number().to64long();
  TRACETOOLS_TRACEPOINT(rmw_send_request, static_cast<const void*>(client), ros_request, *sequence_id);
  return RMW_RET_OK;
}

rmw_ret_t rmw_take_response(const rmw_client_t* client, rmw_service_info_t* request_header, void* ros_response,
                            bool* taken) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_response, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(taken, RMW_RET_INVALID_ARGUMENT);
  Client& owned = client_of(*client);
  *taken = false;
  IncomingMessage incoming{ros_response, nullptr, owned.reader_type};
  fdds::SampleInfo sample;
  bool valid = false;
  // An invalid sample announces the end of a service. It is no response.
  while (!valid && owned.take_next(&incoming, sample)) {
    valid = sample.valid_data;
  }
  if (valid) {
    const auto addressee = sample.related_sample_identity.writer_guid();
    rmw_request_id_t& id = request_header->request_id;
    const auto gid = rmw_fastrtps::to_gid(addressee);
    std::copy(gid.begin(), gid.end(), id.writer_guid);
    id.sequence_number = sample.related_sample_identity.sequence_number().to64long();
    request_header->source_timestamp = sample.source_timestamp.to_ns();
    request_header->received_timestamp = sample.reception_timestamp.to_ns();
    *taken = addressee == owned.reader->guid() || addressee == owned.writer->guid();
    owned.unanswered -= *taken ? 1 : 0;
  }
  TRACETOOLS_TRACEPOINT(rmw_take_response, static_cast<const void*>(client), ros_response,
                        request_header->request_id.sequence_number, request_header->source_timestamp, *taken);
  return RMW_RET_OK;
}

rmw_ret_t rmw_get_gid_for_client(const rmw_client_t* client, rmw_gid_t* gid) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(gid, RMW_RET_INVALID_ARGUMENT);
  const auto& bytes = client_of(*client).reader_gid();
  gid->implementation_identifier = kIdentifier;
  std::copy(bytes.begin(), bytes.end(), gid->data);
  return RMW_RET_OK;
}

rmw_ret_t rmw_client_request_publisher_get_actual_qos(const rmw_client_t* client, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  return client_of(*client).get_writer_qos(qos);
}

rmw_ret_t rmw_client_response_subscription_get_actual_qos(const rmw_client_t* client, rmw_qos_profile_t* qos) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  return client_of(*client).get_reader_qos(qos);
}

rmw_ret_t rmw_service_server_is_available(const rmw_node_t* node, const rmw_client_t* client, bool* is_available) {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(is_available, RMW_RET_INVALID_ARGUMENT);
  const Client& owned = client_of(*client);
  // Different numbers: a service is only half matched, or is about to go.
  const int32_t readers = owned.request_readers;
  *is_available = readers > 0 && readers == owned.response_writers;
  return RMW_RET_OK;
}

rmw_ret_t rmw_client_set_on_new_response_callback(rmw_client_t* client, rmw_event_callback_t callback,
                                                  const void* user_data) {
  RMW_CHECK_HANDLE(client, RMW_RET_INVALID_ARGUMENT);
  client_of(*client).set_on_new_data(callback, user_data);
  return RMW_RET_OK;
}
