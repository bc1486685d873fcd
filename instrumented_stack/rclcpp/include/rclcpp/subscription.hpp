// SPDX-License-Identifier: Apache-2.0
// Receives messages of one type from one topic. Created by Node::create_subscription().
#pragma once

#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <rosidl_runtime_cpp/message_initialization.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/experimental/subscription_intra_process.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/get_message_type_support_handle.hpp"
#include "rclcpp/is_ros_compatible_type.hpp"
#include "rclcpp/loaned_message.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/message_memory_strategy.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/subscription_content_filter_options.hpp"
#include "rclcpp/subscription_traits.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/topic_statistics/subscription_topic_statistics.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

// MessageT is a message type or a TypeAdapter.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class Subscription : public SubscriptionBase {
 public:
  using SubscribedType = typename TypeAdapter<MessageT>::custom_type;
  using ROSMessageType = typename TypeAdapter<MessageT>::ros_message_type;
  using CallbackType = AnySubscriptionCallback<MessageT, AllocatorT>;
  using MessageMemoryStrategyType = message_memory_strategy::MessageMemoryStrategy<ROSMessageType, AllocatorT>;
  RCLCPP_SMART_PTR_DEFINITIONS(Subscription)

  // Without a memory strategy (null), messages come from the allocator of the options, and one that was only read is
  // used again. `statistics` may be null. Throws std::invalid_argument for intra-process communication with the history
  // "keep all" or a depth of 0.
  Subscription(node_interfaces::NodeBaseInterface* node_base, const rosidl_message_type_support_t& type_support,
               const std::string& topic, const QoS& qos, CallbackType any_callback,
               const SubscriptionOptionsWithAllocator<AllocatorT>& options,
               std::shared_ptr<MessageMemoryStrategyType> memory_strategy,
               std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics = nullptr)
      : SubscriptionBase(node_base, type_support, topic, qos, options),
        allocator_(*options.get_allocator()),
        any_callback_(std::move(any_callback)),
        memory_strategy_(std::move(memory_strategy)) {
    set_has_memory_strategy(memory_strategy_ != nullptr);
    // The middleware alone delivers bytes.
    if (!any_callback_.is_serialized_message_callback() && uses_intra_process(options, *node_base)) {
      using IntraProcess = experimental::SubscriptionIntraProcess<MessageT, AllocatorT>;
      const auto intra_process = std::make_shared<IntraProcess>(
          any_callback_, allocator_, node_base->get_context(), get_topic_name(), get_actual_qos(),
          detail::resolve_intra_process_buffer_type(options.intra_process_buffer_type, any_callback_));
      join_intra_process(*node_base, intra_process, intra_process->get_callback());
    }
    trace_creation(any_callback_);
    set_topic_statistics(std::move(statistics));
  }

  // Takes the next message without running the callback. Returns false if there is none.
  bool take(ROSMessageType& message_out, MessageInfo& message_info_out) {
    return take_type_erased(&message_out, message_info_out);
  }
  // Takes the next message, converted to the custom type of a TypeAdapter.
  template <typename T>
  std::enable_if_t<!std::is_same_v<T, ROSMessageType> && std::is_same_v<T, SubscribedType>, bool> take(
      T& message_out, MessageInfo& message_info_out) {
    ROSMessageType ros_message;
    if (!take(ros_message, message_info_out)) {
      return false;
    }
    TypeAdapter<MessageT>::convert_to_custom(ros_message, message_out);
    return true;
  }

  // Whether the callback takes messages of intra-process communication as shared pointers.
  bool use_take_shared_method() const { return any_callback_.use_take_shared_method(); }

  // Reading a message sets every member, so the message needs no initial values.
  std::shared_ptr<void> create_message() override {
    if (memory_strategy_) {
      return memory_strategy_->borrow_message();
    }
    return allocator::make_shared<ROSMessageType>(allocator_, rosidl_runtime_cpp::MessageInitialization::SKIP);
  }
  void return_message(std::shared_ptr<void>& message) override {
    if (memory_strategy_) {
      auto typed_message = std::static_pointer_cast<ROSMessageType>(message);
      message.reset();
      memory_strategy_->return_message(typed_message);
    } else {
      message.reset();
    }
  }
  std::shared_ptr<SerializedMessage> create_serialized_message() override {
    return memory_strategy_ ? memory_strategy_->borrow_serialized_message()
                            : SubscriptionBase::create_serialized_message();
  }
  void return_serialized_message(std::shared_ptr<SerializedMessage>& message) override {
    if (memory_strategy_) {
      memory_strategy_->return_serialized_message(message);
    } else {
      message.reset();
    }
  }

 protected:
  [[gnu::hot]] AnySubscriptionCallbackBase& callback() override { return any_callback_; }

 private:
  AllocatorT allocator_;
  CallbackType any_callback_;
  std::shared_ptr<MessageMemoryStrategyType> memory_strategy_;
};

}  // namespace rclcpp
