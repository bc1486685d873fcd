// SPDX-License-Identifier: Apache-2.0
// The intra-process side of Subscription<MessageT>: buffer and callback.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/experimental/create_intra_process_buffer.hpp"
#include "rclcpp/experimental/subscription_intra_process_base.hpp"
#include "rclcpp/type_adapter.hpp"

namespace rclcpp::experimental {

// Takes messages of the type that goes over the wire.
template <typename ROSMessageT, typename AllocatorT>
class SubscriptionROSMsgIntraProcessBuffer : public SubscriptionIntraProcessBase {
 public:
  using SubscriptionIntraProcessBase::SubscriptionIntraProcessBase;

  virtual void provide_intra_process_message(std::shared_ptr<const ROSMessageT> message) = 0;
  virtual void provide_intra_process_message(allocator::UniquePtr<ROSMessageT, AllocatorT> message) = 0;
};

// Takes messages of the type that the subscription was created for. Without a TypeAdapter this is the type on the wire.
template <typename SubscribedT, typename ROSMessageT, typename AllocatorT>
class SubscriptionIntraProcessBuffer : public SubscriptionROSMsgIntraProcessBuffer<ROSMessageT, AllocatorT> {
 public:
  using SubscribedType = SubscribedT;
  using ROSMessageType = ROSMessageT;
  using Base = SubscriptionROSMsgIntraProcessBuffer<ROSMessageType, AllocatorT>;
  using SubscribedUniquePtr = allocator::UniquePtr<SubscribedType, AllocatorT>;

  // Throws std::invalid_argument for a depth of 0.
  SubscriptionIntraProcessBuffer(const AllocatorT& allocator, const Context::SharedPtr& context,
                                 const std::string& topic_name, const QoS& qos, IntraProcessBufferType buffer_type)
      : Base(context, topic_name, qos),
        allocator_(allocator),
        buffer_(create_intra_process_buffer<SubscribedType>(buffer_type, qos, allocator)) {
    rclcpp::detail::trace_ipb_to_subscription(static_cast<buffers::IntraProcessBufferBase*>(buffer_.get()),
                                              static_cast<SubscriptionIntraProcessBase*>(this));
  }

  void provide_intra_process_data(std::shared_ptr<const SubscribedType> message) {
    buffer_->add_shared(std::move(message));
    this->notify();
  }
  void provide_intra_process_data(SubscribedUniquePtr message) {
    buffer_->add_unique(std::move(message));
    this->notify();
  }

  void provide_intra_process_message(std::shared_ptr<const ROSMessageType> message) override {
    if constexpr (std::is_same_v<SubscribedType, ROSMessageType>) {
      provide_intra_process_data(std::move(message));
    } else {
      provide_intra_process_data(to_custom(*message));
    }
  }
  void provide_intra_process_message(allocator::UniquePtr<ROSMessageType, AllocatorT> message) override {
    if constexpr (std::is_same_v<SubscribedType, ROSMessageType>) {
      provide_intra_process_data(std::move(message));
    } else {
      provide_intra_process_data(to_custom(*message));
    }
  }

  bool use_take_shared_method() const override { return buffer_->use_take_shared_method(); }
  size_t available_capacity() const override { return buffer_->available_capacity(); }

 protected:
  bool has_data() const override { return buffer_->has_data(); }

  const typename buffers::IntraProcessBuffer<SubscribedType, AllocatorT>::SharedPtr& buffer() const { return buffer_; }

 private:
  SubscribedUniquePtr to_custom(const ROSMessageType& message) const {
    auto custom = allocator::make_unique<SubscribedType>(allocator_);
    TypeAdapter<SubscribedType, ROSMessageType>::convert_to_custom(message, *custom);
    return custom;
  }

  AllocatorT allocator_;
  typename buffers::IntraProcessBuffer<SubscribedType, AllocatorT>::SharedPtr buffer_;
};

template <typename MessageT, typename AllocatorT = std::allocator<void>>
class SubscriptionIntraProcess
    : public SubscriptionIntraProcessBuffer<typename TypeAdapter<MessageT>::custom_type,
                                            typename TypeAdapter<MessageT>::ros_message_type, AllocatorT> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(SubscriptionIntraProcess)
  using Buffer = SubscriptionIntraProcessBuffer<typename TypeAdapter<MessageT>::custom_type,
                                                typename TypeAdapter<MessageT>::ros_message_type, AllocatorT>;
  using typename Buffer::SubscribedType;
  using typename Buffer::SubscribedUniquePtr;

  SubscriptionIntraProcess(AnySubscriptionCallback<MessageT, AllocatorT> callback, const AllocatorT& allocator,
                           const Context::SharedPtr& context, const std::string& topic_name, const QoS& qos,
                           IntraProcessBufferType buffer_type)
      : Buffer(allocator, context, topic_name, qos, buffer_type), any_callback_(std::move(callback)) {}
  ~SubscriptionIntraProcess() override {
    rclcpp::detail::trace_intra_process_fini(static_cast<SubscriptionIntraProcessBase*>(this), &any_callback_);
  }

  const AnySubscriptionCallbackBase& get_callback() const { return any_callback_; }

  // Null if another thread has already taken the message.
  std::shared_ptr<void> take_data() override {
    auto taken = std::make_shared<Taken>();
    if (this->buffer()->use_take_shared_method()) {
      taken->shared = this->buffer()->consume_shared();
    } else {
      taken->owned = this->buffer()->consume_unique();
    }
    if (!taken->shared && !taken->owned) {
      return nullptr;
    }
    if (this->has_data()) {
      this->guard_condition_.trigger();  // for another waiting thread
    }
    return taken;
  }

 protected:
  void dispatch(const std::shared_ptr<void>& data, const MessageInfo& message_info) override {
    Taken& taken = *static_cast<Taken*>(data.get());
    if (taken.shared) {
      any_callback_.dispatch_intra_process(std::move(taken.shared), message_info);
    } else {
      any_callback_.dispatch_intra_process(std::move(taken.owned), message_info);
    }
  }

 private:
  struct Taken {
    std::shared_ptr<const SubscribedType> shared;
    SubscribedUniquePtr owned;
  };

  AnySubscriptionCallback<MessageT, AllocatorT> any_callback_;
};

}  // namespace rclcpp::experimental
