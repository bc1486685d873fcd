// SPDX-License-Identifier: Apache-2.0
// A user's subscription callback in any of its forms.
//
// With M the message type, the custom type of a TypeAdapter, or SerializedMessage, a callback takes one of
//   const M &   std::shared_ptr<const M>   std::shared_ptr<M>   std::unique_ptr<M>
// and optionally a const MessageInfo & after it.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/detail/callback_symbol.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/type_adapter.hpp"

namespace rclcpp {

// The part that does not depend on the message type. The address of this object is the `callback` of the trace events,
// so it must not move after trace_registration().
class AnySubscriptionCallbackBase {
 public:
  virtual ~AnySubscriptionCallbackBase() = default;

  // Whether the callback takes the message as bytes.
  bool is_serialized_message_callback() const { return is_serialized_; }

  // Whether the callback cannot keep the message. Then the next message may use the same memory.
  bool takes_reference() const { return takes_reference_; }

  // Whether the callback does not change the message. Then it may be shared with other subscriptions.
  bool use_take_shared_method() const { return use_take_shared_; }

  // Runs the callback. `message` is a ROS message, or a SerializedMessage if the callback takes one. It must have no
  // other owner, because it may be moved from.
  virtual void dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info) = 0;

  void trace_registration() const { symbol_.trace_registration(this); }

 protected:
  void trace_start(bool is_intra_process) const;
  void trace_end() const;

  bool is_serialized_ = false;
  bool takes_reference_ = false;
  bool use_take_shared_ = false;
  detail::CallbackSymbol symbol_;
};

template <typename MessageT, typename AllocatorT = std::allocator<void>>
class AnySubscriptionCallback : public AnySubscriptionCallbackBase {
 public:
  using Adapter = TypeAdapter<MessageT>;
  using SubscribedType = typename Adapter::custom_type;
  using ROSMessageType = typename Adapter::ros_message_type;
  template <typename T>
  using UniquePtr = allocator::UniquePtr<T, AllocatorT>;

  explicit AnySubscriptionCallback(const AllocatorT& allocator = AllocatorT()) : allocator_(allocator) {}

  template <typename CallbackT>
  AnySubscriptionCallback& set(CallbackT callback) {
    symbol_ = detail::CallbackSymbol::of(callback);
    // The order decides for a callback that fits several forms: by reference before shared before owned, the custom
    // type before the ROS type.
    choose<std::decay_t<CallbackT>, const SubscribedType&, std::shared_ptr<const SubscribedType>,
           std::shared_ptr<SubscribedType>, UniquePtr<SubscribedType>, const ROSMessageType&,
           std::shared_ptr<const ROSMessageType>, std::shared_ptr<ROSMessageType>, UniquePtr<ROSMessageType>,
           const SerializedMessage&, std::shared_ptr<const SerializedMessage>, std::shared_ptr<SerializedMessage>,
           UniquePtr<SerializedMessage>>(std::move(callback));
    return *this;
  }

  [[gnu::hot]] void dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info) override {
    run(Message(&message), message_info, false);
  }

  // Like dispatch(), for a message from a publisher of this context. Others may read the message too, or the callback
  // owns it.
  void dispatch_intra_process(std::shared_ptr<const SubscribedType> message, const MessageInfo& message_info) {
    run(Message(std::move(message)), message_info, true);
  }
  void dispatch_intra_process(UniquePtr<SubscribedType> message, const MessageInfo& message_info) {
    run(Message(std::move(message)), message_info, true);
  }

 private:
  // The source of the message: the middleware (we are the only owner), or a publisher of this context.
  using Taken = const std::shared_ptr<void>*;
  using Shared = std::shared_ptr<const SubscribedType>;
  using Owned = UniquePtr<SubscribedType>;
  using Message = std::variant<Taken, Shared, Owned>;

  template <typename T>
  struct Pointee {
    using type = std::remove_const_t<std::remove_reference_t<T>>;
  };
  template <typename T>
  struct Pointee<std::shared_ptr<T>> {
    using type = std::remove_const_t<T>;
  };
  template <typename T, typename DeleterT>
  struct Pointee<std::unique_ptr<T, DeleterT>> {
    using type = T;
  };

  // Whether the middleware provides an M.
  template <typename M>
  static constexpr bool kIsTaken = std::is_same_v<M, ROSMessageType> || std::is_same_v<M, SerializedMessage>;
  // Whether a publisher of this context provides an M.
  template <typename M>
  static constexpr bool kIsPassed = std::is_same_v<M, SubscribedType>;

  void run(Message message, const MessageInfo& message_info, bool is_intra_process) {
    trace_start(is_intra_process);
    deliver_(*this, message, message_info);
    trace_end();
  }

  // An M that the callback owns; made or copied if needed.
  template <typename M>
  UniquePtr<M> owned(Message& message) const {
    if (const Taken* taken = std::get_if<Taken>(&message)) {
      if constexpr (kIsTaken<M>) {
        return allocator::make_unique<M>(allocator_, std::move(*static_cast<M*>((*taken)->get())));
      } else {
        auto custom = allocator::make_unique<M>(allocator_);
        Adapter::convert_to_custom(*static_cast<const ROSMessageType*>((*taken)->get()), *custom);
        return custom;
      }
    }
    if constexpr (kIsPassed<M>) {
      if (Owned* passed = std::get_if<Owned>(&message)) {
        return std::move(*passed);
      }
      return allocator::make_unique<M>(allocator_, *std::get<Shared>(message));
    } else if constexpr (std::is_same_v<M, SerializedMessage>) {
      throw std::logic_error("a callback for serialized messages got a message that is not serialized");
    } else {
      auto ros_message = allocator::make_unique<M>(allocator_);
      Adapter::convert_to_ros_message(passed_value(message), *ros_message);
      return ros_message;
    }
  }

  // `T` is M or const M.
  template <typename T, typename M = std::remove_const_t<T>>
  std::shared_ptr<T> shared(Message& message) const {
    if constexpr (kIsTaken<M>) {
      if (const Taken* taken = std::get_if<Taken>(&message)) {
        return std::static_pointer_cast<T>(**taken);
      }
    }
    if constexpr (kIsPassed<M> && std::is_const_v<T>) {
      if (Shared* passed = std::get_if<Shared>(&message)) {
        return std::move(*passed);
      }
    }
    return owned<M>(message);
  }

  // `temporary` keeps an object that had to be made.
  template <typename M>
  const M& reference(Message& message, std::shared_ptr<const M>& temporary) const {
    if constexpr (kIsTaken<M>) {
      if (const Taken* taken = std::get_if<Taken>(&message)) {
        return *static_cast<const M*>((*taken)->get());
      }
    }
    if constexpr (kIsPassed<M>) {
      if (!std::holds_alternative<Taken>(message)) {
        return passed_value(message);
      }
    }
    temporary = shared<const M>(message);
    return *temporary;
  }

  static const SubscribedType& passed_value(const Message& message) {
    const Owned* passed = std::get_if<Owned>(&message);
    return passed ? **passed : *std::get<Shared>(message);
  }

  template <typename ArgumentT, typename FunctionT>
  void with(Message& message, FunctionT function) const {
    using M = typename Pointee<ArgumentT>::type;
    if constexpr (std::is_reference_v<ArgumentT>) {
      std::shared_ptr<const M> temporary;
      function(reference<M>(message, temporary));
    } else if constexpr (std::is_same_v<ArgumentT, UniquePtr<M>>) {
      function(owned<M>(message));
    } else {
      function(shared<typename ArgumentT::element_type>(message));
    }
  }

  template <typename CallbackT, typename ArgumentT, typename... OtherTs>
  void choose(CallbackT callback) {
    using M = typename Pointee<ArgumentT>::type;
    if constexpr (std::is_invocable_v<CallbackT&, ArgumentT>) {
      deliver_ = [callback = std::move(callback)](const AnySubscriptionCallback& self, Message& message,
                                                  const MessageInfo&) mutable {
        self.with<ArgumentT>(message, [&](auto&& argument) { callback(std::forward<decltype(argument)>(argument)); });
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, ArgumentT, const MessageInfo&>) {
      deliver_ = [callback = std::move(callback)](const AnySubscriptionCallback& self, Message& message,
                                                  const MessageInfo& info) mutable {
        self.with<ArgumentT>(message,
                             [&](auto&& argument) { callback(std::forward<decltype(argument)>(argument), info); });
      };
    } else {
      static_assert(sizeof...(OtherTs) > 0, "the callback takes none of the arguments that a subscription can give it");
      if constexpr (sizeof...(OtherTs) > 0) {
        return choose<CallbackT, OtherTs...>(std::move(callback));
      }
    }
    is_serialized_ = std::is_same_v<M, SerializedMessage>;
    takes_reference_ = std::is_reference_v<ArgumentT>;
    use_take_shared_ = takes_reference_ || std::is_same_v<ArgumentT, std::shared_ptr<const M>>;
  }

  AllocatorT allocator_;
  std::function<void(const AnySubscriptionCallback&, Message&, const MessageInfo&)> deliver_;
};

}  // namespace rclcpp
