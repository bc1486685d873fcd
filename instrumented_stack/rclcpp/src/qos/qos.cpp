// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/qos.hpp"

#include <rmw/qos_profiles.h>

#include <stdexcept>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp {

namespace {

bool equal(const rmw_time_t& left, const rmw_time_t& right) {
  return left.sec == right.sec && left.nsec == right.nsec;
}

}  // namespace

QoSInitialization QoSInitialization::from_rmw(const rmw_qos_profile_t& rmw_qos) {
  switch (rmw_qos.history) {
    case RMW_QOS_POLICY_HISTORY_KEEP_ALL:
      return KeepAll();
    case RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT:
      return KeepLast(rmw_qos.depth, false);
    case RMW_QOS_POLICY_HISTORY_KEEP_LAST:
    case RMW_QOS_POLICY_HISTORY_UNKNOWN:
      return KeepLast(rmw_qos.depth);
  }
  throw std::invalid_argument("Invalid history policy enum value passed to QoSInitialization::from_rmw");
}

QoS::QoS(const QoSInitialization& qos_initialization) : QoS(qos_initialization, rmw_qos_profile_default) {}

QoS::QoS(const QoSInitialization& qos_initialization, const rmw_qos_profile_t& initial_profile)
    : profile_(initial_profile) {
  profile_.history = qos_initialization.history_policy;
  profile_.depth = qos_initialization.depth;
}

bool operator==(const QoS& left, const QoS& right) {
  const rmw_qos_profile_t& l = left.get_rmw_qos_profile();
  const rmw_qos_profile_t& r = right.get_rmw_qos_profile();
  return l.history == r.history && l.depth == r.depth && l.reliability == r.reliability &&
         l.durability == r.durability && equal(l.deadline, r.deadline) && equal(l.lifespan, r.lifespan) &&
         l.liveliness == r.liveliness && equal(l.liveliness_lease_duration, r.liveliness_lease_duration) &&
         l.avoid_ros_namespace_conventions == r.avoid_ros_namespace_conventions;
}

bool operator!=(const QoS& left, const QoS& right) {
  return !(left == right);
}

ClockQoS::ClockQoS(const QoSInitialization& history) : QoS(history) {
  best_effort();
}
SensorDataQoS::SensorDataQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_sensor_data) {}
ParametersQoS::ParametersQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_parameters) {}
ServicesQoS::ServicesQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_services_default) {}
ParameterEventsQoS::ParameterEventsQoS(const QoSInitialization& history)
    : QoS(history, rmw_qos_profile_parameter_events) {}
RosoutQoS::RosoutQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_rosout_default) {}
SystemDefaultsQoS::SystemDefaultsQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_system_default) {}
BestAvailableQoS::BestAvailableQoS(const QoSInitialization& history) : QoS(history, rmw_qos_profile_best_available) {}

std::string qos_policy_name_from_kind(rmw_qos_policy_kind_t policy_kind) {
  switch (policy_kind) {
    case RMW_QOS_POLICY_DURABILITY:
      return "DURABILITY_QOS_POLICY";
    case RMW_QOS_POLICY_DEADLINE:
      return "DEADLINE_QOS_POLICY";
    case RMW_QOS_POLICY_LIVELINESS:
      return "LIVELINESS_QOS_POLICY";
    case RMW_QOS_POLICY_RELIABILITY:
      return "RELIABILITY_QOS_POLICY";
    case RMW_QOS_POLICY_HISTORY:
      return "HISTORY_QOS_POLICY";
    case RMW_QOS_POLICY_LIFESPAN:
      return "LIFESPAN_QOS_POLICY";
    case RMW_QOS_POLICY_DEPTH:
      return "DEPTH_QOS_POLICY";
    case RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION:
      return "LIVELINESS_LEASE_DURATION_QOS_POLICY";
    case RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS:
      return "AVOID_ROS_NAMESPACE_CONVENTIONS_QOS_POLICY";
    default:
      return "INVALID_QOS_POLICY";
  }
}

QoSCheckCompatibleResult qos_check_compatible(const QoS& publisher_qos, const QoS& subscription_qos) {
  rmw_qos_compatibility_type_t compatibility = RMW_QOS_COMPATIBILITY_OK;
  char reason[2048] = "";
  detail::require_ok(
      rmw_qos_profile_check_compatible(publisher_qos.get_rmw_qos_profile(), subscription_qos.get_rmw_qos_profile(),
                                       &compatibility, reason, sizeof(reason)),
      "failed to check compatibility of QoS profiles");
  return {static_cast<QoSCompatibility>(compatibility), reason};
}

}  // namespace rclcpp
