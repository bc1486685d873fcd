// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/qos_overriding_options.hpp"

#include <utility>

namespace rclcpp {

const char* qos_policy_kind_to_cstr(const QosPolicyKind& policy_kind) {
  switch (policy_kind) {
    case QosPolicyKind::AvoidRosNamespaceConventions:
      return "avoid_ros_namespace_conventions";
    case QosPolicyKind::Deadline:
      return "deadline";
    case QosPolicyKind::Depth:
      return "depth";
    case QosPolicyKind::Durability:
      return "durability";
    case QosPolicyKind::History:
      return "history";
    case QosPolicyKind::Lifespan:
      return "lifespan";
    case QosPolicyKind::Liveliness:
      return "liveliness";
    case QosPolicyKind::LivelinessLeaseDuration:
      return "liveliness_lease_duration";
    case QosPolicyKind::Reliability:
      return "reliability";
    case QosPolicyKind::Invalid:
      break;
  }
  throw std::invalid_argument("unknown QoS policy kind");
}

std::ostream& operator<<(std::ostream& stream, const QosPolicyKind& policy_kind) {
  return stream << qos_policy_kind_to_cstr(policy_kind);
}

QosOverridingOptions::QosOverridingOptions(std::initializer_list<QosPolicyKind> policy_kinds,
                                           QosCallback validation_callback, std::string id)
    : id_(std::move(id)), policy_kinds_(policy_kinds), validation_callback_(std::move(validation_callback)) {}

QosOverridingOptions QosOverridingOptions::with_default_policies(QosCallback validation_callback, std::string id) {
  return QosOverridingOptions({QosPolicyKind::History, QosPolicyKind::Depth, QosPolicyKind::Reliability},
                              std::move(validation_callback), std::move(id));
}

}  // namespace rclcpp
