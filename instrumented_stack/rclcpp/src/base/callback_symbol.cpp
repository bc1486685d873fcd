// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/callback_symbol.hpp"

#include <tracetools/tracetools.h>

#include <cstdlib>
#include <tracetools/utils.hpp>

namespace rclcpp::detail {

void CallbackSymbol::trace_registration([[maybe_unused]] const void* callback) const {
  // Demangling is expensive, so it is done only if tracing is possible.
  if (TRACETOOLS_TRACEPOINT_ENABLED(rclcpp_callback_register)) {
    char* symbol = function_ ? tracetools::detail::get_symbol_funcptr(function_)
                             : tracetools::detail::demangle_symbol(type_->name());
    TRACETOOLS_DO_TRACEPOINT(rclcpp_callback_register, callback, symbol);
    std::free(symbol);
  }
}

}  // namespace rclcpp::detail
