// SPDX-License-Identifier: Apache-2.0
// What a trace tells of callbacks: their functions, their starts and their ends.
#include <tracetools/tracetools.h>

#include <cstdlib>
#include <tracetools/utils.hpp>

#include "rclcpp/any_service_callback.hpp"
#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/detail/callback_symbol.hpp"

namespace rclcpp {

void detail::CallbackSymbol::trace_registration([[maybe_unused]] const void* callback) const {
  // Demangling is expensive, so it is done only if tracing is possible.
  // An entity may have no callback yet.
  if ((function_ || type_) && TRACETOOLS_TRACEPOINT_ENABLED(rclcpp_callback_register)) {
    char* symbol = function_ ? tracetools::detail::get_symbol_funcptr(function_)
                             : tracetools::detail::demangle_symbol(type_->name());
    TRACETOOLS_DO_TRACEPOINT(rclcpp_callback_register, callback, symbol);
    std::free(symbol);
  }
}

[[gnu::hot]] void AnySubscriptionCallbackBase::trace_start([[maybe_unused]] bool is_intra_process) const {
  TRACETOOLS_TRACEPOINT(callback_start, static_cast<const void*>(this), is_intra_process);
}

[[gnu::hot]] void AnySubscriptionCallbackBase::trace_end() const {
  TRACETOOLS_TRACEPOINT(callback_end, static_cast<const void*>(this));
}

void AnyServiceCallbackBase::trace_start() const {
  TRACETOOLS_TRACEPOINT(callback_start, static_cast<const void*>(this), false);
}

void AnyServiceCallbackBase::trace_end() const {
  TRACETOOLS_TRACEPOINT(callback_end, static_cast<const void*>(this));
}

}  // namespace rclcpp
