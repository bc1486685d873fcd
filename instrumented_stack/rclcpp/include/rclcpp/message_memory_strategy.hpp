// SPDX-License-Identifier: Apache-2.0
// Where a subscription takes the memory of its messages from. Derive from MessageMemoryStrategy and hand it to
// create_subscription().
#pragma once

#include <rcutils/allocator.h>

#include <cstddef>
#include <memory>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/serialized_message.hpp"

namespace rclcpp::message_memory_strategy {

// Makes each message anew with an allocator. A subscription asks for a message, reads the next one into it, runs the
// callback, and returns the message; the callback may keep a pointer to it. Executors with several threads may call the
// functions at the same time.
template <typename MessageT, typename Alloc = std::allocator<void>>
class MessageMemoryStrategy {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MessageMemoryStrategy)

  using MessageAllocTraits = allocator::AllocRebind<MessageT, Alloc>;
  using MessageAlloc = typename MessageAllocTraits::allocator_type;
  using MessageDeleter = allocator::Deleter<MessageAlloc, MessageT>;
  using SerializedMessageAllocTraits = allocator::AllocRebind<SerializedMessage, Alloc>;
  using SerializedMessageAlloc = typename SerializedMessageAllocTraits::allocator_type;
  using SerializedMessageDeleter = allocator::Deleter<SerializedMessageAlloc, SerializedMessage>;
  using BufferAllocTraits = allocator::AllocRebind<char, Alloc>;
  using BufferAlloc = typename BufferAllocTraits::allocator_type;
  using BufferDeleter = allocator::Deleter<BufferAlloc, char>;

  MessageMemoryStrategy() : MessageMemoryStrategy(std::make_shared<Alloc>()) {}
  explicit MessageMemoryStrategy(const std::shared_ptr<Alloc>& allocator)
      : message_allocator_(std::make_shared<MessageAlloc>(*allocator)),
        serialized_message_allocator_(std::make_shared<SerializedMessageAlloc>(*allocator)),
        buffer_allocator_(std::make_shared<BufferAlloc>(*allocator)),
        rcutils_allocator_(allocator::get_rcl_allocator<char, BufferAlloc>(*buffer_allocator_)) {}
  virtual ~MessageMemoryStrategy() = default;

  static SharedPtr create_default() { return std::make_shared<MessageMemoryStrategy>(); }

  virtual std::shared_ptr<MessageT> borrow_message() {
    return std::allocate_shared<MessageT, MessageAlloc>(*message_allocator_);
  }
  // The subscription has no more use for the message.
  virtual void return_message(std::shared_ptr<MessageT>& msg) { msg.reset(); }

  // The same for callbacks that take the bytes of messages.
  virtual std::shared_ptr<SerializedMessage> borrow_serialized_message(size_t capacity) {
    return std::make_shared<SerializedMessage>(capacity);
  }
  virtual std::shared_ptr<SerializedMessage> borrow_serialized_message() {
    return borrow_serialized_message(default_buffer_capacity_);
  }
  virtual void set_default_buffer_capacity(size_t capacity) { default_buffer_capacity_ = capacity; }
  virtual void return_serialized_message(std::shared_ptr<SerializedMessage>& serialized_msg) { serialized_msg.reset(); }

  std::shared_ptr<MessageAlloc> message_allocator_;
  MessageDeleter message_deleter_;
  std::shared_ptr<SerializedMessageAlloc> serialized_message_allocator_;
  SerializedMessageDeleter serialized_message_deleter_;
  std::shared_ptr<BufferAlloc> buffer_allocator_;
  BufferDeleter buffer_deleter_;
  size_t default_buffer_capacity_ = 0;
  rcutils_allocator_t rcutils_allocator_;
};

}  // namespace rclcpp::message_memory_strategy
