// SPDX-License-Identifier: Apache-2.0
// The absence of everything.
#pragma once

namespace tracing {

inline constexpr const char* kNothingRecorded =
    "no userspace event was recorded: no program that ran has events of the session and was registered with the "
    "session daemon";

}  // namespace tracing
