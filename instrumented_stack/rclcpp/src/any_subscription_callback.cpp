#include "rclcpp/any_subscription_callback.hpp"

#include <tracetools/tracetools.h>

namespace rclcpp {

void AnySubscriptionCallbackBase::dispatch(const std::shared_ptr<void>& message, const MessageInfo& message_info) {
  TRACETOOLS_TRACEPOINT(callback_start, static_cast<const void*>(this), false);
  deliver_(message, message_info);
  TRACETOOLS_TRACEPOINT(callback_end, static_cast<const void*>(this));
}

}  // namespace rclcpp
