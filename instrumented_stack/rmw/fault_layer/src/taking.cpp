// SPDX-License-Identifier: Apache-2.0
// The functions of rmw for subscriptions.
#include <cstring>

#include "endpoints_waited_for.hpp"

namespace rmw_fault_layer {

namespace {

struct Subscription {
  const rosidl_message_type_support_t* type;
  std::shared_ptr<IncomingMessages> messages;
};

// Never destroyed: see publishing.cpp.
Registry<Subscription>& subscriptions() {
  static auto& instance = *new Registry<Subscription>;
  return instance;
}

// Into a message of the type.
rmw_ret_t take(const Subscription& faulty, const rmw_subscription_t* subscription, void* message, void* info,
               bool* taken, rmw_subscription_allocation_t* allocation) {
  static auto* const take_next = next<decltype(::rmw_take_with_info)>("rmw_take_with_info");
  return faulty.messages->take({.take =
                                    [&](void* own_info, bool& is_taken) {
                                      return take_next(subscription, message, &is_taken,
                                                       static_cast<rmw_message_info_t*>(own_info), allocation);
                                    },
                                .bytes = [&] { return serialize(message, faulty.type); },
                                .set = [&](const Bytes& bytes) { return deserialize(bytes, faulty.type, message); }},
                               info, *taken);
}

bool assign(const Bytes& bytes, rmw_serialized_message_t& message) {
  if (message.buffer_capacity < bytes.size()) {
    void* const memory = message.allocator.reallocate(message.buffer, bytes.size(), message.allocator.state);
    if (memory == nullptr) {
      return false;
    }
    message.buffer = static_cast<std::uint8_t*>(memory);
    message.buffer_capacity = bytes.size();
  }
  std::memcpy(message.buffer, bytes.data(), bytes.size());
  message.buffer_length = bytes.size();
  return true;
}

rmw_ret_t take_serialized(const Subscription& faulty, const rmw_subscription_t* subscription,
                          rmw_serialized_message_t* message, void* info, bool* taken,
                          rmw_subscription_allocation_t* allocation) {
  static auto* const take_next =
      next<decltype(::rmw_take_serialized_message_with_info)>("rmw_take_serialized_message_with_info");
  return faulty.messages->take(
      {.take =
           [&](void* own_info, bool& is_taken) {
             return take_next(subscription, message, &is_taken, static_cast<rmw_message_info_t*>(own_info), allocation);
           },
       .bytes = [&] { return Bytes(message->buffer, message->buffer + message->buffer_length); },
       .set = [&](const Bytes& bytes) { return assign(bytes, *message); }},
      info, *taken);
}

}  // namespace

RMW_FAULT_LAYER_FUNCTION rmw_subscription_t* rmw_create_subscription(const rmw_node_t* node,
                                                                     const rosidl_message_type_support_t* type_support,
                                                                     const char* topic_name,
                                                                     const rmw_qos_profile_t* qos,
                                                                     const rmw_subscription_options_t* options) {
  static auto* const create = next<decltype(::rmw_create_subscription)>("rmw_create_subscription");
  rmw_subscription_t* const subscription = create(node, type_support, topic_name, qos, options);
  if (subscription != nullptr) {
    if (auto faults = faults_of(rmw_message_faults::Side::kTake, subscription->topic_name, node)) {
      auto messages = std::make_shared<IncomingMessages>(std::move(faults), size_of_message_info(),
                                                         subscription->topic_name, node->context);
      waited_for().add(subscription->data, messages);
      subscriptions().add(subscription, std::make_shared<Subscription>(Subscription{type_support, messages}));
    }
  }
  return subscription;
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_destroy_subscription(rmw_node_t* node, rmw_subscription_t* subscription) {
  static auto* const destroy = next<decltype(::rmw_destroy_subscription)>("rmw_destroy_subscription");
  if (subscriptions().remove(subscription) != nullptr) {
    (void)waited_for().remove(subscription->data);
  }
  return destroy(node, subscription);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_take(const rmw_subscription_t* subscription, void* message, bool* taken,
                                            rmw_subscription_allocation_t* allocation) {
  static auto* const take_next = next<decltype(::rmw_take)>("rmw_take");
  const std::shared_ptr<Subscription> faulty = subscriptions().find(subscription);
  return faulty == nullptr ? take_next(subscription, message, taken, allocation)
                           : take(*faulty, subscription, message, nullptr, taken, allocation);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_take_with_info(const rmw_subscription_t* subscription, void* message,
                                                      bool* taken, rmw_message_info_t* info,
                                                      rmw_subscription_allocation_t* allocation) {
  static auto* const take_next = next<decltype(::rmw_take_with_info)>("rmw_take_with_info");
  const std::shared_ptr<Subscription> faulty = subscriptions().find(subscription);
  return faulty == nullptr ? take_next(subscription, message, taken, info, allocation)
                           : take(*faulty, subscription, message, info, taken, allocation);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_take_serialized_message(const rmw_subscription_t* subscription,
                                                               rmw_serialized_message_t* message, bool* taken,
                                                               rmw_subscription_allocation_t* allocation) {
  static auto* const take_next = next<decltype(::rmw_take_serialized_message)>("rmw_take_serialized_message");
  const std::shared_ptr<Subscription> faulty = subscriptions().find(subscription);
  return faulty == nullptr ? take_next(subscription, message, taken, allocation)
                           : take_serialized(*faulty, subscription, message, nullptr, taken, allocation);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_take_serialized_message_with_info(const rmw_subscription_t* subscription,
                                                                         rmw_serialized_message_t* message, bool* taken,
                                                                         rmw_message_info_t* info,
                                                                         rmw_subscription_allocation_t* allocation) {
  static auto* const take_next =
      next<decltype(::rmw_take_serialized_message_with_info)>("rmw_take_serialized_message_with_info");
  const std::shared_ptr<Subscription> faulty = subscriptions().find(subscription);
  return faulty == nullptr ? take_next(subscription, message, taken, info, allocation)
                           : take_serialized(*faulty, subscription, message, info, taken, allocation);
}

RMW_FAULT_LAYER_FUNCTION rmw_ret_t rmw_subscription_set_on_new_message_callback(rmw_subscription_t* subscription,
                                                                                rmw_event_callback_t callback,
                                                                                const void* user_data) {
  static auto* const set =
      next<decltype(::rmw_subscription_set_on_new_message_callback)>("rmw_subscription_set_on_new_message_callback");
  if (const std::shared_ptr<Subscription> faulty = subscriptions().find(subscription)) {
    faulty->messages->set_callback(callback, user_data);
  }
  return set(subscription, callback, user_data);
}

}  // namespace rmw_fault_layer
