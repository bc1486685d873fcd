// SPDX-License-Identifier: Apache-2.0
// Names of objects as people read them.
#pragma once

#include <string>

#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// "/ping"; empty when the trace does not tell.
std::string node_name(const ObjectModel& objects, const CallbackObject& callback);

// What calls the callback: "timer 500 ms", "subscription /pong", "service /add", "client of /add", "callback 0x7f…".
std::string callback_source(const ObjectModel& objects, const CallbackObject& callback);

// "500 ms", "33.3 ms", "1.5 s": without digits that are 0.
std::string period_text(std::int64_t period_ns);

}  // namespace tracing
