// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/object_names.hpp"

#include <fmt/format.h>

namespace tracing {

std::string period_text(std::int64_t period_ns) {
  constexpr const char* kUnits[] = {"ns", "us", "ms", "s"};
  double value = static_cast<double>(period_ns);
  std::size_t unit = 0;
  for (; value >= 1'000 && unit + 1 < std::size(kUnits); ++unit) {
    value /= 1'000;
  }
  return fmt::format("{:.4g} {}", value, kUnits[unit]);
}

std::string node_name(const ObjectModel& objects, const CallbackObject& callback) {
  const ObjectId node = objects.node_of(callback);
  return node == kNoObject ? std::string() : objects.nodes()[node].name;
}

std::string callback_source(const ObjectModel& objects, const CallbackObject& callback) {
  using Owner = CallbackObject::Owner;
  if (const ObjectId subscription = objects.subscription_of(callback); subscription != kNoObject) {
    return "subscription " + objects.topics()[objects.subscriptions()[subscription].topic].name;
  }
  if (callback.owner == Owner::kClient && callback.owner_id == kNoObject) {
    return fmt::format("client {:#x}", callback.address);
  }
  if (callback.owner == Owner::kUnknown || callback.owner == Owner::kSubscription || callback.owner_id == kNoObject) {
    return fmt::format("callback {:#x}", callback.address);
  }
  if (callback.owner == Owner::kTimer) {
    return "timer " + period_text(objects.timers()[callback.owner_id].period_ns);
  }
  if (callback.owner == Owner::kService) {
    return "service " + objects.services()[callback.owner_id].name;
  }
  return "client of " + objects.clients()[callback.owner_id].name;
}

}  // namespace tracing
