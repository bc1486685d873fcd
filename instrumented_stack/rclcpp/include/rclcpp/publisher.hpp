// SPDX-License-Identifier: Apache-2.0
// Sends messages of one type on one topic. Created by Node::create_publisher().
#pragma once

#include <algorithm>
#include <functional>
#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/experimental/create_intra_process_buffer.hpp"
#include "rclcpp/experimental/intra_process_manager.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/get_message_type_support_handle.hpp"
#include "rclcpp/is_ros_compatible_type.hpp"
#include "rclcpp/loaned_message.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/type_adapter.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

// MessageT is a message type or a TypeAdapter. Publishing is thread safe.
//
// With intra-process communication a message goes to the subscriptions of the same context by pointer. It also goes
// through the middleware if there are other subscriptions, or if the publisher is transient local. A message published
// as a std::unique_ptr is not copied for a single subscription, nor for any number that only read it.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class Publisher : public PublisherBase {
 public:
  using PublishedType = typename TypeAdapter<MessageT>::custom_type;
  using ROSMessageType = typename TypeAdapter<MessageT>::ros_message_type;
  using MessageUniquePtr = allocator::UniquePtr<ROSMessageType, AllocatorT>;
  using PublishedUniquePtr = allocator::UniquePtr<PublishedType, AllocatorT>;
  static constexpr bool kIsAdapted = !std::is_same_v<PublishedType, ROSMessageType>;
  RCLCPP_SMART_PTR_DEFINITIONS(Publisher)

  Publisher(node_interfaces::NodeBaseInterface* node_base, const std::string& topic, const QoS& qos,
            const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>())
      : PublisherBase(node_base, topic, *rosidl_typesupport_cpp::get_message_type_support_handle<ROSMessageType>(), qos,
                      options),
        allocator_(*options.get_allocator()) {}

  // Joins intra-process communication if options and node enable it. Call it once after the constructor, as
  // create_publisher() does. Throws std::invalid_argument if the QoS does not allow it: history "keep all" or depth 0.
  virtual void post_init_setup(node_interfaces::NodeBaseInterface* node_base, const std::string& /*topic*/,
                               const QoS& /*qos*/, const PublisherOptionsWithAllocator<AllocatorT>& options) {
    if (!uses_intra_process(options, *node_base)) {
      return;
    }
    experimental::IntraProcessManager::Replay replay;
    if (get_actual_qos().durability() == DurabilityPolicy::TransientLocal) {
      buffer_ = experimental::create_intra_process_buffer<ROSMessageType>(IntraProcessBufferType::SharedPtr,
                                                                          get_actual_qos(), allocator_);
      replay = [buffer = buffer_](experimental::SubscriptionIntraProcessBase& subscription) {
        using Target = experimental::SubscriptionROSMsgIntraProcessBuffer<ROSMessageType, AllocatorT>;
        if (auto* target = dynamic_cast<Target*>(&subscription)) {
          for (const std::shared_ptr<const ROSMessageType>& message : buffer->get_all_data_shared()) {
            target->provide_intra_process_message(message);
          }
        }
      };
    }
    join_intra_process(node_base->get_context()->get_sub_context<experimental::IntraProcessManager>(),
                       std::move(replay));
  }

  // Throw exceptions::RCLError. Do nothing if the context has ended.
  virtual void publish(MessageUniquePtr message) { publish_owned(std::move(message)); }
  virtual void publish(const ROSMessageType& message) { publish_reference(message); }

  // Publishes the custom type of a TypeAdapter.
  template <typename T>
  std::enable_if_t<kIsAdapted && std::is_same_v<T, PublishedType>> publish(
      allocator::UniquePtr<T, AllocatorT> message) {
    publish_owned(std::move(message));
  }
  template <typename T>
  std::enable_if_t<kIsAdapted && std::is_same_v<T, PublishedType>> publish(const T& message) {
    publish_reference(message);
  }

  // Borrows a message in memory of the middleware, if its type allows that. Fill it and publish it.
  LoanedMessage<ROSMessageType, AllocatorT> borrow_loaned_message() {
    return LoanedMessage<ROSMessageType, AllocatorT>(*this, allocator_);
  }
  // Publishes without a copy, unless subscriptions of this context use intra-process communication. Throws
  // std::runtime_error for a message that was already published.
  virtual void publish(LoanedMessage<ROSMessageType, AllocatorT>&& message) {
    if (!message.is_valid()) {
      throw std::runtime_error("loaned message is not valid");
    }
    if (intra_process_is_enabled()) {
      publish_reference(message.get());
    } else if (ROSMessageType* loan = message.release_loan()) {
      publish_loaned(loan);
    } else {
      publish_inter_process(*message.release_own());
    }
  }

  // Publishes through the middleware only. Intra-process subscriptions would get nothing, so it throws
  // std::runtime_error if the publisher uses intra-process communication.
  void publish(const SerializedMessage& message) { publish_serialized(message.get_rcl_serialized_message()); }
  void publish(const rcl_serialized_message_t& message) { publish_serialized(message); }

  AllocatorT get_allocator() const { return allocator_; }

 protected:
  // Publishes what LoanedMessage::release() returned.
  void do_loaned_message_publish(std::unique_ptr<ROSMessageType, std::function<void(ROSMessageType*)>> message) {
    publish_loaned(message.get());
  }

 private:
  template <typename T>
  void publish_owned(allocator::UniquePtr<T, AllocatorT> message) {
    if (!intra_process_is_enabled()) {
      publish_inter_process(*message);
      return;
    }
    trace_intra_publish(message.get());
    const auto manager = intra_process_manager();
    if (!inter_process_publish_needed()) {
      manager->template do_intra_process_publish<T, ROSMessageType, AllocatorT>(intra_process_publisher_id(),
                                                                                std::move(message), allocator_);
      return;
    }
    const std::shared_ptr<const T> shared =
        manager->template do_intra_process_publish_and_return_shared<T, ROSMessageType, AllocatorT>(
            intra_process_publisher_id(), std::move(message), allocator_, [this](const std::shared_ptr<const T>& kept) {
              if (buffer_) {
                buffer_->add_shared(to_ros_message(kept));
              }
            });
    publish_inter_process(*shared);
  }

  template <typename T>
  [[gnu::hot]] void publish_reference(const T& message) {
    if (!intra_process_is_enabled()) {
      publish_inter_process(message);
    } else if (!buffer_ && get_intra_process_subscription_count() == 0) {
      // No subscription will keep it, so no copy is needed.
      trace_intra_publish(&message);
      if (inter_process_publish_needed()) {
        publish_inter_process(message);
      }
    } else {
      publish_owned<T>(allocator::make_unique<T>(allocator_, message));
    }
  }

  template <typename T>
  void publish_inter_process(const T& message) {
    if constexpr (std::is_same_v<T, ROSMessageType>) {
      publish_message(&message);
    } else {
      auto ros_message = allocator::make_unique<ROSMessageType>(allocator_);
      TypeAdapter<MessageT>::convert_to_ros_message(message, *ros_message);
      publish_message(ros_message.get());
    }
  }

  template <typename T>
  std::shared_ptr<const ROSMessageType> to_ros_message(const std::shared_ptr<const T>& message) const {
    if constexpr (std::is_same_v<T, ROSMessageType>) {
      return message;
    } else {
      auto ros_message = allocator::make_shared<ROSMessageType>(allocator_);
      TypeAdapter<MessageT>::convert_to_ros_message(*message, *ros_message);
      return ros_message;
    }
  }

  // A transient local publisher always writes, because subscriptions of other processes may come later.
  bool inter_process_publish_needed() const {
    return buffer_ || get_subscription_count() > get_intra_process_subscription_count();
  }

  AllocatorT allocator_;
  // The messages for late subscriptions of this context; used by a transient local publisher with intra-process
  // communication.
  typename experimental::buffers::IntraProcessBuffer<ROSMessageType, AllocatorT>::SharedPtr buffer_;
};

}  // namespace rclcpp
