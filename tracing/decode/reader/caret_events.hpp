// SPDX-License-Identifier: Apache-2.0
// The events of CARET (provider `ros2_caret`), whose preloaded library stands before tracetools.
//
// It records the initialisation events of ROS 2 under its own provider, with the time at which they happened: once at
// that time, and once more when a session begins that is younger. Then they come kind by kind, not in their order.
// `dds_write` stands for rmw_publish. Other events tell of executors and callback groups.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

// Executors keep their groups themselves, or in a collector of their own.
struct CaretEvent {
  enum class Kind : std::uint8_t {
    kExecutor,         // first: the executor, second: its collector or 0; text: single_threaded_executor, …
    kExecutorGroup,    // first: the executor, second: the group; text: mutually_exclusive, reentrant
    kCollectorGroup,   // first: the collector; the rest likewise
    kTimer,            // first: the group, second: rcl's handle of the timer that was added to it
    kSubscription,     // likewise
    kService,          // likewise
    kClient,           // likewise
    kSourceTimestamp,  // number: of the message that the thread has written
    kSimulatedTime,    // number: what a node with use_sim_time took for the time
  };
  Kind kind = Kind::kExecutor;
  Handle first = 0;
  Handle second = 0;
  std::int64_t number = 0;
  std::string_view text;
  bool operator==(const CaretEvent&) const = default;
};

using KnownCaretEvent = std::variant<AnyEvent, CaretEvent>;

class CaretDecoder {
 public:
  struct Decoded {
    // Of an initialisation event: when it happened, on a clock of the process's machine.
    std::optional<std::int64_t> init_ns;
    KnownCaretEvent event;
  };
  // Null for another event. Valid until the next call.
  const Decoded* decode(const Event& event);

 private:
  struct Plan {
    bool is_known = false;
    bool has_counterpart = false;  // in provider ros2
    CaretEvent::Kind kind = CaretEvent::Kind::kExecutor;
    std::optional<std::size_t> first, second, number, text, init;  // indices of fields
  };
  static Plan plan_of(const EventClass& event_class);

  ByEventClass<Plan> plans_;
  Decoder counterparts_{[](const std::string&) {}, Decoder::Provider::kCaret};
  Decoded decoded_;
};

}  // namespace tracing::ros2
