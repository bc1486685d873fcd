// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/any_subscription_callback.hpp"

#include <tracetools/tracetools.h>

namespace rclcpp {

[[gnu::hot]] void AnySubscriptionCallbackBase::trace_start([[maybe_unused]] bool is_intra_process) const {
  TRACETOOLS_TRACEPOINT(callback_start, static_cast<const void*>(this), is_intra_process);
}

[[gnu::hot]] void AnySubscriptionCallbackBase::trace_end() const {
  TRACETOOLS_TRACEPOINT(callback_end, static_cast<const void*>(this));
}

}  // namespace rclcpp
