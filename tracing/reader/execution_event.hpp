// What executors and clients do that ROS 2 has no event for, and provider `ros2_ext` records.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/reader/event.hpp"
#include "tracing/reader/ros2_events.hpp"

namespace tracing::ros2 {

struct ExecutionEvent {
  enum class Kind : std::uint8_t {
    kService,              // an executor begins to serve it: rclcpp_executor_execute_service
    kClient,               // rclcpp_executor_execute_client
    kWaitable,             // rclcpp_executor_execute_waitable
    kClientCallbackStart,  // a client hands out a response: rclcpp_client_callback_start
    kClientCallbackEnd,
  };
  Kind kind = Kind::kService;
  Handle handle = 0;  // rcl's of the service or the client; the waitable's address
  bool operator==(const ExecutionEvent&) const = default;
};

// For the events of one reader.
class ExecutionEventDecoder {
 public:
  // Nothing when it is another event.
  std::optional<ExecutionEvent> decode(const Event& event);

 private:
  using Kind = std::optional<ExecutionEvent::Kind>;
  std::vector<std::optional<Kind>> kinds_;  // by EventClass::id, as far as asked for
};

}  // namespace tracing::ros2
