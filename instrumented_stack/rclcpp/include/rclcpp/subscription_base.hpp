// SPDX-License-Identifier: Apache-2.0
// The common part of all subscriptions, and the interface of a subscription for executors.
#pragma once

#include <rcl/subscription.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/dynamic_typesupport/dynamic_message.hpp"
#include "rclcpp/dynamic_typesupport/dynamic_message_type.hpp"
#include "rclcpp/dynamic_typesupport/dynamic_serialization_support.hpp"
#include "rclcpp/event_handler.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/network_flow_endpoint.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_options.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

namespace experimental {
class IntraProcessManager;
class SubscriptionIntraProcessBase;
}  // namespace experimental

namespace topic_statistics {
class SubscriptionTopicStatistics;
}  // namespace topic_statistics

// What a subscription hands to its callback.
enum class DeliveredMessageKind : uint8_t { INVALID = 0, ROS_MESSAGE = 1, SERIALIZED_MESSAGE = 2, DYNAMIC_MESSAGE = 3 };

class SubscriptionBase : public std::enable_shared_from_this<SubscriptionBase> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(SubscriptionBase)

  // Throws exceptions::InvalidTopicNameError or exceptions::RCLError.
  SubscriptionBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_message_type_support_t& type_support,
                   const std::string& topic, const QoS& qos, const SubscriptionOptionsBase& options);
  virtual ~SubscriptionBase();
  RCLCPP_DISABLE_COPY(SubscriptionBase)

  // The full, remapped name.
  const char* get_topic_name() const;
  QoS get_actual_qos() const;
  // The number of matched publishers.
  size_t get_publisher_count() const;
  const rosidl_message_type_support_t& get_message_type_support_handle() const { return type_support_; }

  // Takes the next message into `message_out`, which points to a message of this subscription's type. Returns false if
  // there is none.
  bool take_type_erased(void* message_out, MessageInfo& message_info_out);
  bool take_serialized(SerializedMessage& message_out, MessageInfo& message_info_out);

  // The addresses at which the subscription listens. Throws exceptions::RCLError.
  std::vector<NetworkFlowEndpoint> get_network_flow_endpoints() const;

  // Whether messages are taken without a copy from the memory of the middleware: for plain types, if the environment
  // variable ROS_DISABLE_LOANED_MESSAGES is 0. Executors do so for callbacks that take a const reference, because these
  // cannot keep the message.
  bool can_loan_messages() const { return can_loan_messages_; }

  // Whether there is a content filter.
  bool is_cft_supported() const { return rcl_subscription_is_cft_supported(subscription_handle_.get()); }
  bool is_cft_enabled() const { return rcl_subscription_is_cft_enabled(subscription_handle_.get()); }
  // Selects the messages that are wanted from now on, see ContentFilterOptions; an empty expression ends the filter.
  // Messages not yet taken are lost when a filter is first set or is removed. Any thread. Throws exceptions::RCLError
  // and changes nothing if the filter does not fit the messages, if it is empty and there is none, and for a
  // subscription with intra-process communication.
  void set_content_filter(const std::string& filter_expression,
                          const std::vector<std::string>& expression_parameters = {});
  // Throws exceptions::RCLError if there is no filter.
  ContentFilterOptions get_content_filter() const;

  // Receives messages from publishers of the same context. Null if they come through the middleware like all others.
  std::shared_ptr<Waitable> get_intra_process_waitable() const;

  // Executors call it for a subscription that is ready. It takes one message and runs the callback.
  void execute();
  // For executors of others that take messages themselves: make one, take it, run the callback, return it. For
  // is_serialized(), the message is a SerializedMessage for take_serialized().
  bool is_serialized() { return callback().is_serialized_message_callback(); }
  DeliveredMessageKind get_delivered_message_kind() {
    return is_serialized() ? DeliveredMessageKind::SERIALIZED_MESSAGE : DeliveredMessageKind::ROS_MESSAGE;
  }
  virtual std::shared_ptr<void> create_message() = 0;
  virtual std::shared_ptr<SerializedMessage> create_serialized_message() {
    return std::make_shared<SerializedMessage>();
  }
  void handle_message(const std::shared_ptr<void>& message, const MessageInfo& message_info);
  // The message stays the caller's.
  void handle_loaned_message(void* loaned_message, const MessageInfo& message_info) {
    handle_message(std::shared_ptr<void>(loaned_message, [](void*) {}), message_info);
  }
  void handle_serialized_message(const std::shared_ptr<SerializedMessage>& message, const MessageInfo& message_info) {
    dispatch(message, message_info);
  }
  virtual void return_message(std::shared_ptr<void>& message) { message.reset(); }
  virtual void return_serialized_message(std::shared_ptr<SerializedMessage>& message) { message.reset(); }

  // For types that are made at run time, which no subscription has: as in rclcpp so far, these throw
  // exceptions::UnimplementedError.
  virtual dynamic_typesupport::DynamicMessageType::SharedPtr get_shared_dynamic_message_type();
  virtual dynamic_typesupport::DynamicMessage::SharedPtr get_shared_dynamic_message();
  virtual dynamic_typesupport::DynamicSerializationSupport::SharedPtr get_shared_dynamic_serialization_support();
  virtual dynamic_typesupport::DynamicMessage::SharedPtr create_dynamic_message();
  virtual void return_dynamic_message(dynamic_typesupport::DynamicMessage::SharedPtr& message);
  virtual void handle_dynamic_message(const dynamic_typesupport::DynamicMessage::SharedPtr& message,
                                      const MessageInfo& message_info);
  bool take_dynamic_message(dynamic_typesupport::DynamicMessage& message_out, MessageInfo& message_info_out);

  // The handlers of the callbacks in the options, and the default one.
  using EventHandlers = std::unordered_map<rcl_subscription_event_type_t, std::shared_ptr<EventHandlerBase>>;
  const EventHandlers& get_event_handlers() const { return event_handlers_; }

  std::shared_ptr<rcl_subscription_t> get_subscription_handle() { return subscription_handle_; }
  std::shared_ptr<const rcl_subscription_t> get_subscription_handle() const { return subscription_handle_; }

  // For executors that are notified instead of waiting. `callback` gets the number of new messages; it is also called
  // for those that already wait to be taken when it is set. Threads of the middleware call it, so it must only take
  // note. Throws std::invalid_argument for an empty callback. Do not call either function from the callback.
  void set_on_new_message_callback(std::function<void(size_t)> callback);
  void clear_on_new_message_callback();
  // The same for events, see PublisherBase, and for messages of intra-process communication. Without a handler for the
  // type, or without intra-process communication, a warning is logged and nothing happens.
  void set_on_new_qos_event_callback(std::function<void(size_t)> callback, rcl_subscription_event_type_t event_type);
  void clear_on_new_qos_event_callback(rcl_subscription_event_type_t event_type);
  void set_on_new_intra_process_message_callback(std::function<void(size_t)> callback);
  void clear_on_new_intra_process_message_callback();
  // Without callbacks, messages are taken and forgotten; a callback that runs already ends in its time. Any thread.
  void disable_callbacks();
  void enable_callbacks();
  // Sets whether a wait set uses this subscription; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // Sets the statistics of this subscription's messages; null: none. Call it before the subscription is executed.
  void set_topic_statistics(std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics);

  // The group that serves this subscription, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

 protected:
  virtual AnySubscriptionCallbackBase& callback() = 0;

  // With a memory strategy, execute() takes every message from create_message() and gives it to return_message(), or
  // the same for serialized messages.
  void set_has_memory_strategy(bool has) { has_memory_strategy_ = has; }

  // Call it in the most derived constructor, when the callback has its final address.
  void trace_creation(const AnySubscriptionCallbackBase& callback);

  // False with a content filter, because the filter needs the bytes of messages. Throws std::invalid_argument if
  // intra-process communication is enabled but the QoS does not allow it.
  bool uses_intra_process(const SubscriptionOptionsBase& options,
                          const node_interfaces::NodeBaseInterface& node_base) const;
  void join_intra_process(node_interfaces::NodeBaseInterface& node_base,
                          std::shared_ptr<experimental::SubscriptionIntraProcessBase> intra_process,
                          const AnySubscriptionCallbackBase& callback);

 private:
  friend class Executor;

  void execute_loaned();
  void dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info);
  void trace_callback(const void* subscription, const AnySubscriptionCallbackBase& callback) const;
  // Whether the same message also comes through intra-process communication.
  bool is_delivered_twice(const MessageInfo& message_info) const;
  bool check_taken(rcl_ret_t ret) const;
  void bind_event_callbacks(const SubscriptionEventCallbacks& callbacks, bool use_default_callbacks,
                            const std::string& logger_name);
  // A message, or serialized message, for the callback; it is returned after the callback.
  std::shared_ptr<void> borrow_message();
  void keep_message(std::shared_ptr<void> message);
  void return_to_strategy(std::shared_ptr<void> message);

  std::shared_ptr<rcl_subscription_t> subscription_handle_;
  const rosidl_message_type_support_t& type_support_;
  CallbackGroup::WeakPtr callback_group_;
  // Null: not used.
  std::shared_ptr<experimental::IntraProcessManager> intra_process_manager_;
  std::shared_ptr<experimental::SubscriptionIntraProcessBase> intra_process_;
  uint64_t intra_process_subscription_id_ = 0;
  EventHandlers event_handlers_;
  detail::OnReadyCallback on_ready_;
  std::atomic_bool in_use_by_wait_set_{false};
  std::atomic_bool has_callbacks_{true};
  std::uint64_t passed_over_ = 0;  // of the executor
  std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics_;
  const void* traced_callback_ = nullptr;  // set by trace_creation()
  // A callback that takes a reference gets its message in this memory, without an allocation. Executors may run such a
  // callback several times at once. If the memory is in use, the message is allocated.
  std::atomic_flag is_spare_in_use_ = ATOMIC_FLAG_INIT;
  std::shared_ptr<void> spare_message_;
  bool can_loan_messages_ = false;
  bool has_memory_strategy_ = false;
};

}  // namespace rclcpp
