// What all subscriptions have in common, and what an executor needs to know of one.
#pragma once

#include <rcl/subscription.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp {

class SubscriptionBase : public std::enable_shared_from_this<SubscriptionBase> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(SubscriptionBase)

  // Throws exceptions::InvalidTopicNameError or exceptions::RCLError.
  SubscriptionBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_message_type_support_t& type_support,
                   const std::string& topic, const QoS& qos, const SubscriptionOptions& options);
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

  // What an executor does with a subscription that is ready: one message, from the middleware to the callback.
  void execute();

  std::shared_ptr<rcl_subscription_t> get_subscription_handle() { return subscription_handle_; }
  std::shared_ptr<const rcl_subscription_t> get_subscription_handle() const { return subscription_handle_; }

  // The group that serves this subscription, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

 protected:
  virtual std::shared_ptr<void> create_message() = 0;
  virtual AnySubscriptionCallbackBase& callback() = 0;

  // To be called by the most derived constructor, when the callback is where it will stay.
  void trace_creation(const AnySubscriptionCallbackBase& callback);

 private:
  bool check_taken(rcl_ret_t ret) const;
  // A message, or serialized message, for the callback, and after the callback the way back.
  std::shared_ptr<void> borrow_message();
  void return_message(std::shared_ptr<void> message);

  std::shared_ptr<rcl_subscription_t> subscription_handle_;
  const rosidl_message_type_support_t& type_support_;
  CallbackGroup::WeakPtr callback_group_;
  const void* traced_callback_ = nullptr;  // as trace_creation() told it
  // Where the next message for a callback that takes a reference is read into: it costs no allocation. Executors may
  // run such a callback several times at once.
  std::mutex spare_mutex_;
  std::shared_ptr<void> spare_message_;
};

}  // namespace rclcpp
