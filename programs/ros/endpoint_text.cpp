// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/endpoint_text.hpp"

#include <fmt/format.h>

#include <map>
#include <type_traits>

namespace launch {

namespace {

std::string duration_text(const rmw_time_t& time) {
  const rmw_time_t infinite = RMW_DURATION_INFINITE;
  const rmw_time_t unspecified = RMW_DURATION_UNSPECIFIED;
  const auto is = [&](const rmw_time_t& other) { return time.sec == other.sec && time.nsec == other.nsec; };
  if (is(infinite) || is(unspecified)) {
    return "Infinite";
  }
  return fmt::format("{} nanoseconds", time.sec * 1'000'000'000 + time.nsec);
}

template <typename Policy>
std::string text_of(Policy policy, const std::map<std::type_identity_t<Policy>, const char*>& names) {
  const auto found = names.find(policy);
  return found == names.end() ? "UNKNOWN" : found->second;
}

std::string history_text(const rmw_qos_profile_t& qos) {
  return qos.history == RMW_QOS_POLICY_HISTORY_KEEP_LAST
             ? fmt::format("KEEP_LAST ({})", qos.depth)
             : text_of(qos.history, {{RMW_QOS_POLICY_HISTORY_KEEP_ALL, "KEEP_ALL"},
                                     {RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string reliability_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.reliability, {{RMW_QOS_POLICY_RELIABILITY_RELIABLE, "RELIABLE"},
                                   {RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, "BEST_EFFORT"},
                                   {RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string durability_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.durability, {{RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL, "TRANSIENT_LOCAL"},
                                  {RMW_QOS_POLICY_DURABILITY_VOLATILE, "VOLATILE"},
                                  {RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

std::string liveliness_text(const rmw_qos_profile_t& qos) {
  return text_of(qos.liveliness, {{RMW_QOS_POLICY_LIVELINESS_AUTOMATIC, "AUTOMATIC"},
                                  {RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC, "MANUAL_BY_TOPIC"},
                                  {RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, "SYSTEM_DEFAULT"}});
}

}  // namespace

std::string gid_text(const rclcpp::TopicEndpointInfo& endpoint) {
  std::string gid;
  for (const std::uint8_t byte : endpoint.endpoint_gid()) {
    gid += fmt::format("{}{:02x}", gid.empty() ? "" : ".", byte);
  }
  return gid;
}

std::string qos_text(const rclcpp::TopicEndpointInfo& endpoint, const std::string& indent) {
  const rmw_qos_profile_t& qos = endpoint.qos_profile().get_rmw_qos_profile();
  return fmt::format(
      "{0}Reliability: {1}\n"
      "{0}History (Depth): {2}\n"
      "{0}Durability: {3}\n"
      "{0}Lifespan: {4}\n"
      "{0}Deadline: {5}\n"
      "{0}Liveliness: {6}\n"
      "{0}Liveliness lease duration: {7}",
      indent, reliability_text(qos), history_text(qos), durability_text(qos), duration_text(qos.lifespan),
      duration_text(qos.deadline), liveliness_text(qos), duration_text(qos.liveliness_lease_duration));
}

}  // namespace launch
