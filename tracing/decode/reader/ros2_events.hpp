// SPDX-License-Identifier: Apache-2.0
// The events of ros2_tracing as structs, one per event, from the table that tracetools uses for recording.
#pragma once

#include <cstddef>
#include <variant>

#include "launch_trace/typed_events.hpp"

namespace tracing::ros2 {

using launch_trace::FieldMember;
using launch_trace::FieldType;
using launch_trace::Gid;
using launch_trace::Handle;
using namespace launch_trace::ros2;

inline constexpr std::size_t kEventCount = std::variant_size_v<AnyEvent> - 1;

}  // namespace tracing::ros2
