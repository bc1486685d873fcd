// SPDX-License-Identifier: Apache-2.0
// What all subscriptions have in common, and what an executor needs to know of one.
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
#include "rclcpp/event_handler.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/network_flow_endpoint.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
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

class SubscriptionBase : public std::enable_shared_from_this<SubscriptionBase> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(SubscriptionBase)

  // Throws exceptions::InvalidTopicNameError or exceptions::RCLError.
  SubscriptionBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_message_type_support_t& type_support,
                   const std::string& topic, const QoS& qos, const SubscriptionOptionsBase& options);
  virtual ~SubscriptionBase();
  RCLCPP_DISABLE_COPY(SubscriptionBase)

  // The full name, after remapping.
  const char* get_topic_name() const;
  QoS get_actual_qos() const;
  // Matched publishers.
  size_t get_publisher_count() const;
  const rosidl_message_type_support_t& get_message_type_support_handle() const { return type_support_; }

  // The next message into `message_out`, which points to a message of this subscription's type. False if there is none.
  bool take_type_erased(void* message_out, MessageInfo& message_info_out);
  bool take_serialized(SerializedMessage& message_out, MessageInfo& message_info_out);

  // Where the subscription listens. Throws exceptions::RCLError.
  std::vector<NetworkFlowEndpoint> get_network_flow_endpoints() const;

  // Whether messages are taken where the middleware holds them: those of plain types, if the environment variable
  // ROS_DISABLE_LOANED_MESSAGES is 0. Executors do so for callbacks that take a const reference, which cannot keep it.
  bool can_loan_messages() const { return can_loan_messages_; }

  // Whether there is a content filter.
  bool is_cft_enabled() const { return rcl_subscription_is_cft_enabled(subscription_handle_.get()); }
  // Which messages are wanted from now on, see ContentFilterOptions; an empty expression ends the filter. Messages that
  // wait to be taken are lost when the subscription gets its first filter, or loses it. Any thread. Throws
  // exceptions::RCLError, and nothing changes, for a filter that does not fit the messages, for an empty one where
  // there is none, and for a subscription with intra-process communication.
  void set_content_filter(const std::string& filter_expression,
                          const std::vector<std::string>& expression_parameters = {});
  // Throws exceptions::RCLError if there is no filter.
  ContentFilterOptions get_content_filter() const;

  // Where messages of publishers of the same context arrive; null if they come through the middleware like all others.
  std::shared_ptr<Waitable> get_intra_process_waitable() const;

  // What an executor does with a subscription that is ready: one message, from the middleware to the callback.
  void execute();

  // Of the callbacks in the options, and the default one.
  using EventHandlers = std::unordered_map<rcl_subscription_event_type_t, std::shared_ptr<EventHandlerBase>>;
  const EventHandlers& get_event_handlers() const { return event_handlers_; }

  std::shared_ptr<rcl_subscription_t> get_subscription_handle() { return subscription_handle_; }
  std::shared_ptr<const rcl_subscription_t> get_subscription_handle() const { return subscription_handle_; }

  // For executors that are told instead of waiting: `callback` gets the number of new messages, also of those that wait
  // to be taken when it is set. It is called by threads of the middleware and must only take note. Throws
  // std::invalid_argument for an empty callback. Neither is to be called from the callback.
  void set_on_new_message_callback(std::function<void(size_t)> callback);
  void clear_on_new_message_callback();
  // Sets whether a wait set uses this; the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // What measures this subscription's messages; null: nothing. To be called before it is executed.
  void set_topic_statistics(std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics);

  // The group that serves this subscription, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

 protected:
  virtual std::shared_ptr<void> create_message() = 0;
  virtual AnySubscriptionCallbackBase& callback() = 0;

  // To be called by the most derived constructor, when the callback is where it will stay.
  void trace_creation(const AnySubscriptionCallbackBase& callback);

  // Not with a content filter, which is made for the bytes of messages. Throws std::invalid_argument if intra-process
  // communication is wanted and the QoS is not made for it.
  bool uses_intra_process(const SubscriptionOptionsBase& options,
                          const node_interfaces::NodeBaseInterface& node_base) const;
  void join_intra_process(const node_interfaces::NodeBaseInterface& node_base,
                          std::shared_ptr<experimental::SubscriptionIntraProcessBase> intra_process,
                          const AnySubscriptionCallbackBase& callback);

 private:
  void execute_loaned();
  void dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info);
  void trace_callback(const void* subscription, const AnySubscriptionCallbackBase& callback) const;
  // Whether the same message comes through intra-process communication.
  bool is_delivered_twice(const MessageInfo& message_info) const;
  bool check_taken(rcl_ret_t ret) const;
  void bind_event_callbacks(const SubscriptionEventCallbacks& callbacks, bool use_default_callbacks,
                            const std::string& logger_name);
  template <typename EventCallbackT>
  void add_event_handler(const EventCallbackT& callback, rcl_subscription_event_type_t event_type);
  // A message, or serialized message, for the callback, and after the callback the way back.
  std::shared_ptr<void> borrow_message();
  void return_message(std::shared_ptr<void> message);

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
  std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics_;
  const void* traced_callback_ = nullptr;  // as trace_creation() told it
  // Where the next message for a callback that takes a reference is read into: it costs no allocation. Executors may
  // run such a callback several times at once: who finds the place in use does without it.
  std::atomic_flag is_spare_in_use_ = ATOMIC_FLAG_INIT;
  std::shared_ptr<void> spare_message_;
  bool can_loan_messages_ = false;
};

}  // namespace rclcpp
