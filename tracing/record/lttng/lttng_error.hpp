// SPDX-License-Identifier: Apache-2.0
// The one place where a result of liblttng-ctl becomes a TraceError.
#pragma once

#include <string>

#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

// `result` as the older calls give it: 0 or positive is success, a negative LTTng error code is not. Returns it.
// `doing` names what was tried, for the message: "cannot <doing>: <LTTng's text>".
int check_lttng(int result, const std::string& doing);

// The error for an LTTng error code of either sign, with a remedy where we know one.
TraceError lttng_error(int code, const std::string& doing);

}  // namespace tracing
