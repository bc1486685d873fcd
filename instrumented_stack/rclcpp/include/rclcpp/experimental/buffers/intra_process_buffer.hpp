// SPDX-License-Identifier: Apache-2.0
// The interface of a subscription's buffer for publishers and the subscription. Messages go in and come out as shared
// or unique pointers; the buffer holds one of the two. If the kinds differ, the message is copied.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/detail/intra_process_trace.hpp"
#include "rclcpp/experimental/buffers/buffer_implementation_base.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::experimental::buffers {

class IntraProcessBufferBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(IntraProcessBufferBase)
  virtual ~IntraProcessBufferBase() = default;

  virtual void clear() = 0;
  virtual bool has_data() const = 0;
  // Whether messages can be taken as shared pointers without a copy.
  virtual bool use_take_shared_method() const = 0;
  virtual size_t available_capacity() const = 0;
};

// `DeleterT` is the deleter of unique pointers to messages.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename DeleterT = allocator::Deleter<AllocatorT, MessageT>>
class IntraProcessBuffer : public IntraProcessBufferBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(IntraProcessBuffer)
  using MessageUniquePtr = std::unique_ptr<MessageT, DeleterT>;
  using MessageSharedPtr = std::shared_ptr<const MessageT>;

  virtual void add_shared(MessageSharedPtr message) = 0;
  virtual void add_unique(MessageUniquePtr message) = 0;

  // Removes the oldest message; null if there is none.
  virtual MessageSharedPtr consume_shared() = 0;
  virtual MessageUniquePtr consume_unique() = 0;

  // All messages, oldest first. They stay in the buffer.
  virtual std::vector<MessageSharedPtr> get_all_data_shared() = 0;
  virtual std::vector<MessageUniquePtr> get_all_data_unique() = 0;
};

// Holds pointers of type BufferT: shared or unique.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename DeleterT = allocator::Deleter<AllocatorT, MessageT>,
          typename BufferT = std::unique_ptr<MessageT, DeleterT>>
class TypedIntraProcessBuffer : public IntraProcessBuffer<MessageT, AllocatorT, DeleterT> {
 public:
  using Base = IntraProcessBuffer<MessageT, AllocatorT, DeleterT>;
  using typename Base::MessageSharedPtr;
  using typename Base::MessageUniquePtr;
  static constexpr bool kHoldsShared = std::is_same_v<BufferT, MessageSharedPtr>;
  static_assert(kHoldsShared || std::is_same_v<BufferT, MessageUniquePtr>);

  explicit TypedIntraProcessBuffer(std::unique_ptr<BufferImplementationBase<BufferT>> buffer_impl,
                                   const AllocatorT& allocator = AllocatorT())
      : allocator_(allocator), buffer_(std::move(buffer_impl)) {
    rclcpp::detail::trace_buffer_to_ipb(buffer_.get(), static_cast<IntraProcessBufferBase*>(this));
  }
  ~TypedIntraProcessBuffer() override { rclcpp::detail::trace_ipb_fini(static_cast<IntraProcessBufferBase*>(this)); }
  RCLCPP_DISABLE_COPY(TypedIntraProcessBuffer)

  void add_shared(MessageSharedPtr message) override {
    if constexpr (kHoldsShared) {
      buffer_->enqueue(std::move(message));
    } else {
      buffer_->enqueue(copy(*message));
    }
  }
  void add_unique(MessageUniquePtr message) override { buffer_->enqueue(std::move(message)); }

  MessageSharedPtr consume_shared() override { return buffer_->dequeue(); }
  MessageUniquePtr consume_unique() override {
    if constexpr (kHoldsShared) {
      // Others may own it too.
      const MessageSharedPtr message = buffer_->dequeue();
      return message ? copy(*message) : nullptr;
    } else {
      return buffer_->dequeue();
    }
  }

  std::vector<MessageUniquePtr> get_all_data_unique() override {
    if constexpr (kHoldsShared) {
      std::vector<MessageUniquePtr> all;
      for (const MessageSharedPtr& message : buffer_->get_all_data()) {
        all.push_back(copy(*message));
      }
      return all;
    } else {
      return buffer_->get_all_data();
    }
  }
  std::vector<MessageSharedPtr> get_all_data_shared() override {
    if constexpr (kHoldsShared) {
      return buffer_->get_all_data();
    } else {
      std::vector<MessageSharedPtr> all;
      for (MessageUniquePtr& message : buffer_->get_all_data()) {
        all.push_back(std::move(message));
      }
      return all;
    }
  }

  void clear() override { buffer_->clear(); }
  bool has_data() const override { return buffer_->has_data(); }
  bool use_take_shared_method() const override { return kHoldsShared; }
  size_t available_capacity() const override { return buffer_->available_capacity(); }

 private:
  MessageUniquePtr copy(const MessageT& message) const { return allocator::make_unique<MessageT>(allocator_, message); }

  AllocatorT allocator_;
  std::unique_ptr<BufferImplementationBase<BufferT>> buffer_;
};

}  // namespace rclcpp::experimental::buffers
