// SPDX-License-Identifier: Apache-2.0
// The name of what a callback belongs to, as JSON, pages and exports write it.
#pragma once

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// "subscription", "timer", "service", "client", "unknown"
constexpr const char* owner_name(CallbackResult::Owner owner) {
  switch (owner) {
    case CallbackResult::Owner::kSubscription:
      return "subscription";
    case CallbackResult::Owner::kTimer:
      return "timer";
    case CallbackResult::Owner::kService:
      return "service";
    case CallbackResult::Owner::kClient:
      return "client";
    case CallbackResult::Owner::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace tracing
