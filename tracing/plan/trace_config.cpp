// SPDX-License-Identifier: Apache-2.0
#include "tracing/plan/trace_config.hpp"

#include <array>
#include <ctime>
#include <filesystem>

#include "launcher/base/home_directory.hpp"

namespace tracing {
namespace {

enum class EventKind { kInitialisation, kRuntime };

struct RosEvent {
  const char* name;
  EventKind kind;
};

// In the order of the layers, from creation to use. Source: the tracepoint provider of ros2_tracing's tracetools.
constexpr std::array kRosEvents = {
    RosEvent{"ros2:rcl_init", EventKind::kInitialisation},
    RosEvent{"ros2:rcl_node_init", EventKind::kInitialisation},
    RosEvent{"ros2:rmw_publisher_init", EventKind::kInitialisation},
    RosEvent{"ros2:rcl_publisher_init", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_publish", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_intra_publish", EventKind::kRuntime},
    RosEvent{"ros2:rcl_publish", EventKind::kRuntime},
    RosEvent{"ros2:rmw_publish", EventKind::kRuntime},
    RosEvent{"ros2:rmw_subscription_init", EventKind::kInitialisation},
    RosEvent{"ros2:rcl_subscription_init", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_subscription_init", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_subscription_callback_added", EventKind::kInitialisation},
    RosEvent{"ros2:rmw_take", EventKind::kRuntime},
    RosEvent{"ros2:rcl_take", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_take", EventKind::kRuntime},
    RosEvent{"ros2:rcl_service_init", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_service_callback_added", EventKind::kInitialisation},
    RosEvent{"ros2:rmw_take_request", EventKind::kRuntime},
    RosEvent{"ros2:rmw_send_response", EventKind::kRuntime},
    RosEvent{"ros2:rmw_client_init", EventKind::kInitialisation},
    RosEvent{"ros2:rcl_client_init", EventKind::kInitialisation},
    RosEvent{"ros2:rmw_send_request", EventKind::kRuntime},
    RosEvent{"ros2:rmw_take_response", EventKind::kRuntime},
    RosEvent{"ros2:rcl_timer_init", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_timer_callback_added", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_timer_link_node", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_callback_register", EventKind::kInitialisation},
    RosEvent{"ros2:callback_start", EventKind::kRuntime},
    RosEvent{"ros2:callback_end", EventKind::kRuntime},
    RosEvent{"ros2:rcl_lifecycle_state_machine_init", EventKind::kInitialisation},
    RosEvent{"ros2:rcl_lifecycle_transition", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_executor_get_next_ready", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_executor_wait_for_work", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_executor_execute", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_ipb_to_subscription", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_buffer_to_ipb", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_construct_ring_buffer", EventKind::kInitialisation},
    RosEvent{"ros2:rclcpp_ring_buffer_enqueue", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_ring_buffer_dequeue", EventKind::kRuntime},
    RosEvent{"ros2:rclcpp_ring_buffer_clear", EventKind::kRuntime},
    RosEvent{"ros2:message_link_periodic_async", EventKind::kInitialisation},
    RosEvent{"ros2:message_link_partial_sync", EventKind::kInitialisation},
};

std::string value_or_empty(const std::map<std::string, std::string>& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? std::string() : found->second;
}

std::string absolute_normalised(const std::string& path, const std::map<std::string, std::string>& environment) {
  const std::filesystem::path expanded = launch::expand_home(path, environment);
  // The empty last component ("a/" is "a" and "") is dropped, else the session's name would not follow a single slash.
  const std::filesystem::path normal = std::filesystem::absolute(expanded).lexically_normal();
  return (normal.has_filename() || normal == normal.root_path() ? normal : normal.parent_path()).string();
}

}  // namespace

const std::vector<std::string>& default_ros_events() {
  static const std::vector<std::string> events = [] {
    std::vector<std::string> all;
    for (const RosEvent& event : kRosEvents) all.emplace_back(event.name);
    return all;
  }();
  return events;
}

const std::vector<std::string>& initialisation_ros_events() {
  static const std::vector<std::string> events = [] {
    std::vector<std::string> initialisation;
    for (const RosEvent& event : kRosEvents) {
      if (event.kind == EventKind::kInitialisation) initialisation.emplace_back(event.name);
    }
    return initialisation;
  }();
  return events;
}

const std::vector<std::string>& default_context_fields() {
  static const std::vector<std::string> fields = {"procname", "vpid", "vtid"};
  return fields;
}

std::string TraceConfig::trace_directory() const {
  const std::filesystem::path directory = std::filesystem::path(base_path) / session_name;
  if (dual_runtime) return (directory / "runtime").string();
  if (dual_session) return (directory / "snapshot").string();
  return directory.string();
}

std::string TraceConfig::destination() const {
  if (!over_network()) return trace_directory();
  return url.empty() ? kLocalRelayDaemon : url;
}

std::string TraceConfig::lttng_session_name() const {
  if (dual_runtime) return session_name + "-runtime";
  if (dual_session) return session_name + "-snapshot";
  return session_name;
}

std::string trace_base_path(const std::string& given, const std::map<std::string, std::string>& environment) {
  if (!given.empty()) return absolute_normalised(given, environment);
  if (std::string trace_directory = value_or_empty(environment, "ROS_TRACE_DIR"); !trace_directory.empty()) {
    return absolute_normalised(trace_directory, environment);
  }
  return absolute_normalised(launch::ros_home(environment) + "/tracing", environment);
}

std::string session_timestamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, sizeof "-YYYYMMDDHHMMSS"> text{};
  std::strftime(text.data(), text.size(), "-%Y%m%d%H%M%S", &local);
  return text.data();
}

}  // namespace tracing
