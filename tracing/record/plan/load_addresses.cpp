// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/load_addresses.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>

#include "tracing/record/plan/event_rule.hpp"

namespace tracing {
namespace {

// Of lttng-ust 2.13: when a session starts, and when a library is loaded or unloaded.
constexpr std::array kEvents = {
    "lttng_ust_statedump:bin_info", "lttng_ust_statedump:build_id", "lttng_ust_statedump:debug_link",
    "lttng_ust_lib:load",           "lttng_ust_lib:build_id",       "lttng_ust_lib:debug_link",
    "lttng_ust_lib:unload"};

}  // namespace

bool records_load_addresses(const std::vector<std::string>& events_ust) {
  const std::vector<std::string> patterns = event_patterns(events_ust);
  return std::any_of(patterns.begin(), patterns.end(), [](const std::string& pattern) {
    return std::any_of(kEvents.begin(), kEvents.end(),
                       [&](const char* event) { return fnmatch(pattern.c_str(), event, 0) == 0; });
  });
}

}  // namespace tracing
