// A user's subscription callback in any of its forms.
//
// With M the message type or SerializedMessage, a callback takes one of
//   const M &   std::shared_ptr<const M>   std::shared_ptr<M>   std::unique_ptr<M>
// and, if it likes, a const MessageInfo & after it.
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/callback_symbol.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/serialized_message.hpp"

namespace rclcpp {

// What does not depend on the message type. The address of this object is the `callback` of the trace events, so it
// must not move after trace_registration().
class AnySubscriptionCallbackBase {
 public:
  // Whether the callback wants the bytes.
  bool is_serialized_message_callback() const { return is_serialized_; }

  // Whether the callback cannot keep the message, so that the next one may come in the same memory.
  bool takes_reference() const { return takes_reference_; }

  // Runs the callback. `message` must be of the callback's type and belong to nobody else: it may be moved from.
  void dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info);

  void trace_registration() const { symbol_.trace_registration(this); }

 protected:
  std::function<void(const std::shared_ptr<void>&, const MessageInfo&)> deliver_;
  bool is_serialized_ = false;
  bool takes_reference_ = false;
  detail::CallbackSymbol symbol_;
};

template <typename MessageT>
class AnySubscriptionCallback : public AnySubscriptionCallbackBase {
 public:
  template <typename CallbackT>
  explicit AnySubscriptionCallback(CallbackT callback) {
    symbol_ = detail::CallbackSymbol::of(callback);
    // The order decides for a callback that several forms would fit: by reference before shared before owned.
    set<std::decay_t<CallbackT>, const MessageT&, std::shared_ptr<const MessageT>, std::shared_ptr<MessageT>,
        std::unique_ptr<MessageT>, const SerializedMessage&, std::shared_ptr<const SerializedMessage>,
        std::shared_ptr<SerializedMessage>, std::unique_ptr<SerializedMessage>>(std::move(callback));
  }

 private:
  template <typename T>
  struct Pointee {
    using type = std::remove_const_t<std::remove_reference_t<T>>;
  };
  template <typename T>
  struct Pointee<std::shared_ptr<T>> {
    using type = std::remove_const_t<T>;
  };
  template <typename T>
  struct Pointee<std::unique_ptr<T>> {
    using type = T;
  };

  template <typename ArgumentT>
  static decltype(auto) as(const std::shared_ptr<void>& message) {
    using M = typename Pointee<ArgumentT>::type;
    if constexpr (std::is_reference_v<ArgumentT>) {
      return *static_cast<const M*>(message.get());
    } else if constexpr (std::is_same_v<ArgumentT, std::unique_ptr<M>>) {
      return std::make_unique<M>(std::move(*static_cast<M*>(message.get())));
    } else {
      return std::static_pointer_cast<M>(message);
    }
  }

  template <typename CallbackT, typename ArgumentT, typename... OtherTs>
  void set(CallbackT callback) {
    if constexpr (std::is_invocable_v<CallbackT&, ArgumentT>) {
      deliver_ = [callback = std::move(callback)](const std::shared_ptr<void>& message, const MessageInfo&) mutable {
        callback(as<ArgumentT>(message));
      };
    } else if constexpr (std::is_invocable_v<CallbackT&, ArgumentT, const MessageInfo&>) {
      deliver_ = [callback = std::move(callback)](const std::shared_ptr<void>& message,
                                                  const MessageInfo& info) mutable {
        callback(as<ArgumentT>(message), info);
      };
    } else {
      static_assert(sizeof...(OtherTs) > 0, "the callback takes none of the arguments that a subscription can give it");
      if constexpr (sizeof...(OtherTs) > 0) {
        return set<CallbackT, OtherTs...>(std::move(callback));
      }
    }
    is_serialized_ = std::is_same_v<typename Pointee<ArgumentT>::type, SerializedMessage>;
    takes_reference_ = std::is_reference_v<ArgumentT>;
  }
};

}  // namespace rclcpp
