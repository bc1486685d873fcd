// SPDX-License-Identifier: Apache-2.0
// The state of a lifecycle node that is older than the session, which provider `ros2_ext` records in a state dump.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/handle_event_decoder.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

struct LifecycleState {
  enum class Kind : std::uint8_t { kCurrent };
  Kind kind = Kind::kCurrent;
  Handle state_machine = 0;

  static constexpr std::array<std::pair<std::string_view, Kind>, 1> kKinds{
      {{"ros2_ext:rcl_lifecycle_state", Kind::kCurrent}}};

  // Of the event that was decoded: "active".
  static std::string_view label(const Event& event) {
    const std::optional<FieldValue> value = event.field("label");
    return value ? value->string().value_or("") : "";
  }
};

using LifecycleStateDecoder = HandleEventDecoder<LifecycleState>;

}  // namespace tracing::ros2
