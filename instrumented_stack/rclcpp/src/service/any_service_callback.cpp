// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/any_service_callback.hpp"

#include <tracetools/tracetools.h>

namespace rclcpp {

void AnyServiceCallbackBase::trace_start() const {
  TRACETOOLS_TRACEPOINT(callback_start, static_cast<const void*>(this), false);
}

void AnyServiceCallbackBase::trace_end() const {
  TRACETOOLS_TRACEPOINT(callback_end, static_cast<const void*>(this));
}

}  // namespace rclcpp
