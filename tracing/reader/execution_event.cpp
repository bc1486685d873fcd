#include "tracing/reader/execution_event.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace tracing::ros2 {

namespace {

std::optional<ExecutionEvent::Kind> kind_of(std::string_view event) {
  using Kind = ExecutionEvent::Kind;
  static constexpr std::array<std::pair<std::string_view, Kind>, 5> kKinds{{
      {"ros2_ext:rclcpp_executor_execute_service", Kind::kService},
      {"ros2_ext:rclcpp_executor_execute_client", Kind::kClient},
      {"ros2_ext:rclcpp_executor_execute_waitable", Kind::kWaitable},
      {"ros2_ext:rclcpp_client_callback_start", Kind::kClientCallbackStart},
      {"ros2_ext:rclcpp_client_callback_end", Kind::kClientCallbackEnd},
  }};
  const auto found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& entry) { return entry.first == event; });
  return found == kKinds.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<ExecutionEvent> ExecutionEventDecoder::decode(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= kinds_.size()) kinds_.resize(id + 1);
  if (!kinds_[id]) kinds_[id] = kind_of(event.name());
  const Kind& kind = *kinds_[id];
  if (!kind || event.event_class->fields.empty()) return std::nullopt;
  const std::optional<std::uint64_t> handle = event.field(0).unsigned_integer();
  if (!handle) return std::nullopt;
  return ExecutionEvent{*kind, *handle};
}

}  // namespace tracing::ros2
