// SPDX-License-Identifier: Apache-2.0
// The functions of rmw for servers of services.
#include <thread>

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

// Null before Iron.
const rosidl_message_type_support_t* type_of_requests(const Service& service) {
  return services_tell_their_messages() ? service.type->request_typesupport : nullptr;
}
const rosidl_message_type_support_t* type_of_responses(const Service& service) {
  return services_tell_their_messages() ? service.type->response_typesupport : nullptr;
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
  if (auto faults = faults_of(rmw_message_faults::Side::kRequest, service->service_name, node)) {
    faulty.requests = std::make_shared<IncomingMessages>(std::move(faults), sizeof(rmw_service_info_t),
                                                         service->service_name, node->context);
    waited_for().add(service->data, faulty.requests);
  }
  faulty.responses = faults_of(rmw_message_faults::Side::kResponse, service->service_name, node);
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
  const rosidl_message_type_support_t* const type = type_of_requests(*faulty);
  return faulty->requests->take({.take =
                                     [&](void* own_info, bool& is_taken) {
                                       return take_next(service, static_cast<rmw_service_info_t*>(own_info), request,
                                                        &is_taken);
                                     },
                                 .bytes = [&] { return type == nullptr ? Bytes() : serialize(request, type); },
                                 .set = [&](const Bytes& bytes) { return deserialize(bytes, type, request); }},
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
  if (const auto* const type = type_of_responses(*faulty); type != nullptr && !fate.corruptions.empty()) {
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
