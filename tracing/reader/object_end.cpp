#include "tracing/reader/object_end.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace tracing::ros2 {

namespace {

std::optional<ObjectEnd::Kind> kind_of(std::string_view event) {
  using Kind = ObjectEnd::Kind;
  static constexpr std::array<std::pair<std::string_view, Kind>, 12> kKinds{{
      {"ros2_ext:rcl_node_fini", Kind::kRclNode},
      {"ros2_ext:rmw_publisher_fini", Kind::kRmwPublisher},
      {"ros2_ext:rcl_publisher_fini", Kind::kRclPublisher},
      {"ros2_ext:rmw_subscription_fini", Kind::kRmwSubscription},
      {"ros2_ext:rcl_subscription_fini", Kind::kRclSubscription},
      {"ros2_ext:rclcpp_subscription_fini", Kind::kRclcppSubscription},
      {"ros2_ext:rcl_service_fini", Kind::kRclService},
      {"ros2_ext:rmw_service_fini", Kind::kRmwService},
      {"ros2_ext:rcl_client_fini", Kind::kRclClient},
      {"ros2_ext:rmw_client_fini", Kind::kRmwClient},
      {"ros2_ext:rcl_timer_fini", Kind::kRclTimer},
      {"ros2_ext:rclcpp_callback_fini", Kind::kRclcppCallback},
  }};
  const auto found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& entry) { return entry.first == event; });
  return found == kKinds.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<ObjectEnd> ObjectEndDecoder::decode(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= kinds_.size()) kinds_.resize(id + 1);
  if (!kinds_[id]) kinds_[id] = kind_of(event.name());
  const Kind& kind = *kinds_[id];
  if (!kind || event.event_class->fields.empty()) return std::nullopt;
  const std::optional<std::uint64_t> handle = event.field(0).unsigned_integer();
  if (!handle) return std::nullopt;
  return ObjectEnd{*kind, *handle};
}

}  // namespace tracing::ros2
