// SPDX-License-Identifier: Apache-2.0
// The functions of rmw for servers of services.
#include <cstdio>
#include <initializer_list>
#include <thread>
#include <utility>

#include "endpoints_waited_for.hpp"

namespace rmw_fault_layer {

namespace {

struct Service {
  const rosidl_service_type_support_t* type;
  std::shared_ptr<IncomingMessages> requests;              // null: no fault names them
  std::unique_ptr<rmw_fastrtps::MessageFaults> responses;  // likewise
};

// Never destroyed: see publishing.cpp.
Registry<Service>& services() {
  static auto& instance = *new Registry<Service>;
  return instance;
}

using rmw_message_faults::Kind;

// Before Iron nobody tells how requests and responses become bytes. What needs these is left out, so that the report of
// a test says that it has hit nothing.
std::unique_ptr<rmw_fastrtps::MessageFaults> faults_of_service(rmw_message_faults::Side side, const char* name,
                                                               const rmw_node_t* node,
                                                               std::initializer_list<Kind> kinds_with_bytes) {
  auto faults = faults_of(side, name, node);
  if (faults == nullptr || services_tell_their_messages()) {
    return faults;
  }
  bool is_told = false;
  for (const Kind kind : kinds_with_bytes) {
    if (faults->leave_out(kind) && !std::exchange(is_told, true)) {
      std::fprintf(
          stderr,
          "[rmw] a fault of '%s' is not applied: it needs the bytes of messages of a service, which this ROS 2 "
          "does not give\n",
          name);
    }
  }
  return faults->empty() ? nullptr : std::move(faults);
}

}  // namespace

RMW_FAULT_LAYER_FUNCTION rmw_service_t* rmw_create_service(const rmw_node_t* node,
                                                           const rosidl_service_type_support_t* type_support,
                                                           const char* service_name, const rmw_qos_profile_t* qos) {
  static auto* const create = next<decltype(::rmw_create_service)>("rmw_create_service");
  rmw_service_t* const service = create(node, type_support, service_name, qos);
  if (service == nullptr) {
    return nullptr;
  }
  Service faulty{type_support, nullptr, nullptr};
  if (auto faults = faults_of_service(rmw_message_faults::Side::kRequest, service->service_name, node,
                                      {Kind::kDuplicate, Kind::kDelay, Kind::kCorrupt})) {
    faulty.requests = std::make_shared<IncomingMessages>(std::move(faults), sizeof(rmw_service_info_t),
                                                         service->service_name, node->context);
    waited_for().add(service->data, faulty.requests);
  }
  faulty.responses =
      faults_of_service(rmw_message_faults::Side::kResponse, service->service_name, node, {Kind::kCorrupt});
  if (faulty.requests != nullptr || faulty.responses != nullptr) {
    services().add(service, std::make_shared<Service>(std::move(faulty)));
  }
  return service;
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_destroy_service(rmw_node_t* node, rmw_service_t* service) {
  static auto* const destroy = next<decltype(::rmw_destroy_service)>("rmw_destroy_service");
  if (services().remove(service) != nullptr) {
    (void)waited_for().remove(service->data);
  }
  return destroy(node, service);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_take_request(const rmw_service_t* service, rmw_service_info_t* info,
                                                    void* request, bool* taken) {
  static auto* const take_next = next<decltype(::rmw_take_request)>("rmw_take_request");
  const std::shared_ptr<Service> faulty = services().find(service);
  if (faulty == nullptr || faulty->requests == nullptr) {
    return take_next(service, info, request, taken);
  }
  return faulty->requests->take(
      {.take =
           [&](void* own_info, bool& is_taken) {
             return take_next(service, static_cast<rmw_service_info_t*>(own_info), request, &is_taken);
           },
       .bytes = [&] { return serialize(request, faulty->type->request_typesupport); },
       .set = [&](const Bytes& bytes) { return deserialize(bytes, faulty->type->request_typesupport, request); }},
      info, *taken);
}

// A response cannot be copied, so one that is late keeps its thread waiting.
RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_send_response(const rmw_service_t* service, rmw_request_id_t* request_id,
                                                     void* response) {
  static auto* const send = next<decltype(::rmw_send_response)>("rmw_send_response");
  const std::shared_ptr<Service> faulty = services().find(service);
  if (faulty == nullptr || faulty->responses == nullptr) {
    return send(service, request_id, response);
  }
  const rmw_fastrtps::MessageFate fate = faulty->responses->next();
  if (fate.is_dropped) {
    return RMW_RET_OK;
  }
  if (!fate.corruptions.empty()) {
    const rosidl_message_type_support_t* const type = faulty->type->response_typesupport;
    Bytes bytes = serialize(response, type);
    for (const std::uint64_t seed : fate.corruptions) {
      rmw_fastrtps::corrupt(bytes.data(), bytes.size(), seed);
    }
    if (!deserialize(bytes, type, response)) {
      return RMW_RET_OK;  // nobody could read it
    }
  }
  std::this_thread::sleep_for(fate.delay);
  rmw_ret_t result = RMW_RET_OK;
  for (unsigned copy = 0; copy < fate.copies && result == RMW_RET_OK; ++copy) {
    result = send(service, request_id, response);
  }
  return result;
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_service_set_on_new_request_callback(rmw_service_t* service,
                                                                           rmw_event_callback_t callback,
                                                                           const void* user_data) {
  static auto* const set =
      next<decltype(::rmw_service_set_on_new_request_callback)>("rmw_service_set_on_new_request_callback");
  if (const std::shared_ptr<Service> faulty = services().find(service); faulty != nullptr && faulty->requests) {
    faulty->requests->set_callback(callback, user_data);
  }
  return set(service, callback, user_data);
}

}  // namespace rmw_fault_layer
