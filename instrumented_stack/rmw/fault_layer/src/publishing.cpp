// SPDX-License-Identifier: Apache-2.0
// The functions of rmw for publishers.
#include "outgoing_messages.hpp"
#include "registry.hpp"

namespace rmw_fault_layer {

namespace {

// Never destroyed: publishers may be used until the process ends.
Registry<OutgoingMessages>& publishers() {
  static auto& instance = *new Registry<OutgoingMessages>;
  return instance;
}

}  // namespace

RMW_FAULT_LAYER_FUNCTION rmw_publisher_t* rmw_create_publisher(const rmw_node_t* node,
                                                               const rosidl_message_type_support_t* type_support,
                                                               const char* topic_name, const rmw_qos_profile_t* qos,
                                                               const rmw_publisher_options_t* options) {
  static auto* const create = next<decltype(::rmw_create_publisher)>("rmw_create_publisher");
  rmw_publisher_t* const publisher = create(node, type_support, topic_name, qos, options);
  if (publisher != nullptr) {
    if (auto faults = faults_of(rmw_message_faults::Side::kPublish, publisher->topic_name, node)) {
      publishers().add(publisher, std::make_shared<OutgoingMessages>(publisher, type_support, std::move(faults)));
    }
  }
  return publisher;
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_destroy_publisher(rmw_node_t* node, rmw_publisher_t* publisher) {
  static auto* const destroy = next<decltype(::rmw_destroy_publisher)>("rmw_destroy_publisher");
  (void)publishers().remove(publisher);
  return destroy(node, publisher);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_publish(const rmw_publisher_t* publisher, const void* message,
                                               rmw_publisher_allocation_t* allocation) {
  static auto* const publish = next<decltype(::rmw_publish)>("rmw_publish");
  const auto send = [&] { return publish(publisher, message, allocation); };
  const std::shared_ptr<OutgoingMessages> faulty = publishers().find(publisher);
  return faulty == nullptr ? send() : faulty->publish(send, [&] { return serialize(message, faulty->type()); });
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_publish_serialized_message(const rmw_publisher_t* publisher,
                                                                  const rmw_serialized_message_t* message,
                                                                  rmw_publisher_allocation_t* allocation) {
  static auto* const publish = next<decltype(::rmw_publish_serialized_message)>("rmw_publish_serialized_message");
  const auto send = [&] { return publish(publisher, message, allocation); };
  const std::shared_ptr<OutgoingMessages> faulty = publishers().find(publisher);
  return faulty == nullptr
             ? send()
             : faulty->publish(send, [&] { return Bytes(message->buffer, message->buffer + message->buffer_length); });
}

// A message on loan belongs to the middleware afterwards. With faults it is published by its value, and given back.
RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_publish_loaned_message(const rmw_publisher_t* publisher, void* message,
                                                              rmw_publisher_allocation_t* allocation) {
  static auto* const publish_loan = next<decltype(::rmw_publish_loaned_message)>("rmw_publish_loaned_message");
  const std::shared_ptr<OutgoingMessages> faulty = publishers().find(publisher);
  if (faulty == nullptr) {
    return publish_loan(publisher, message, allocation);
  }
  static auto* const publish = next<decltype(::rmw_publish)>("rmw_publish");
  const rmw_ret_t result = faulty->publish([&] { return publish(publisher, message, allocation); },
                                           [&] { return serialize(message, faulty->type()); });
  (void)next<decltype(rmw_return_loaned_message_from_publisher)>("rmw_return_loaned_message_from_publisher")(publisher,
                                                                                                             message);
  return result;
}

}  // namespace rmw_fault_layer
