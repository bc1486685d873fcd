// SPDX-License-Identifier: Apache-2.0
// Quality of service of a publisher or subscription: how many messages are kept, whether they may be lost, whether late
// subscribers get old ones.
//
//   rclcpp::QoS(10)                                keep the last 10, reliable, volatile
//   rclcpp::QoS(1).transient_local()               the last one also for late subscribers
//   rclcpp::SensorDataQoS()                        newest data first, losses allowed
#pragma once

#include <rmw/qos_policy_kind.h>
#include <rmw/qos_profiles.h>
#include <rmw/types.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "rclcpp/duration.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

enum class HistoryPolicy {
  KeepLast = RMW_QOS_POLICY_HISTORY_KEEP_LAST,
  KeepAll = RMW_QOS_POLICY_HISTORY_KEEP_ALL,
  SystemDefault = RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT,
  Unknown = RMW_QOS_POLICY_HISTORY_UNKNOWN,
};

enum class ReliabilityPolicy {
  BestEffort = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
  Reliable = RMW_QOS_POLICY_RELIABILITY_RELIABLE,
  SystemDefault = RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_RELIABILITY_UNKNOWN,
};

enum class DurabilityPolicy {
  Volatile = RMW_QOS_POLICY_DURABILITY_VOLATILE,
  TransientLocal = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
  SystemDefault = RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_DURABILITY_UNKNOWN,
};

enum class LivelinessPolicy {
  Automatic = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC,
  ManualByTopic = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC,
  SystemDefault = RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_LIVELINESS_UNKNOWN,
};

// The history settings, which every QoS must have.
struct QoSInitialization {
  rmw_qos_history_policy_t history_policy;
  size_t depth;

  // `print_depth_warning` is for sources that pass it: here a depth of 0 gives no warning at this place.
  constexpr QoSInitialization(rmw_qos_history_policy_t history, size_t history_depth, bool print_depth_warning = true)
      : history_policy(history), depth(history_depth) {
    (void)print_depth_warning;
  }

  // Keeps the last `depth` unless the profile says "keep all". Throws std::invalid_argument for a history that is none.
  static QoSInitialization from_rmw(const rmw_qos_profile_t& rmw_qos);
};

struct KeepAll : QoSInitialization {
  KeepAll() : QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_ALL, 0) {}
};

struct KeepLast : QoSInitialization {
  explicit KeepLast(size_t history_depth, bool print_depth_warning = true)
      : QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_LAST, history_depth, print_depth_warning) {}
};

class QoS {
 public:
  // Reliable and volatile unless `initial_profile` says otherwise.
  explicit QoS(const QoSInitialization& qos_initialization);
  QoS(const QoSInitialization& qos_initialization, const rmw_qos_profile_t& initial_profile);
  QoS(size_t history_depth) : QoS(KeepLast(history_depth)) {}  // NOLINT: create_publisher<T>("topic", 10)

  rmw_qos_profile_t& get_rmw_qos_profile() { return profile_; }
  const rmw_qos_profile_t& get_rmw_qos_profile() const { return profile_; }

  QoS& history(HistoryPolicy history) { return this->history(static_cast<rmw_qos_history_policy_t>(history)); }
  QoS& history(rmw_qos_history_policy_t history) { return set(profile_.history, history); }
  QoS& keep_last(size_t depth) { return history(HistoryPolicy::KeepLast).set(profile_.depth, depth); }
  QoS& keep_all() { return history(HistoryPolicy::KeepAll).set(profile_.depth, size_t{0}); }

  QoS& reliability(ReliabilityPolicy reliability) {
    return this->reliability(static_cast<rmw_qos_reliability_policy_t>(reliability));
  }
  QoS& reliability(rmw_qos_reliability_policy_t reliability) { return set(profile_.reliability, reliability); }
  QoS& reliable() { return reliability(ReliabilityPolicy::Reliable); }
  QoS& best_effort() { return reliability(ReliabilityPolicy::BestEffort); }
  QoS& reliability_best_available() { return reliability(ReliabilityPolicy::BestAvailable); }

  QoS& durability(DurabilityPolicy durability) {
    return this->durability(static_cast<rmw_qos_durability_policy_t>(durability));
  }
  QoS& durability(rmw_qos_durability_policy_t durability) { return set(profile_.durability, durability); }
  QoS& durability_volatile() { return durability(DurabilityPolicy::Volatile); }
  QoS& transient_local() { return durability(DurabilityPolicy::TransientLocal); }
  QoS& durability_best_available() { return durability(DurabilityPolicy::BestAvailable); }

  // The longest time between two messages.
  QoS& deadline(const Duration& deadline) { return this->deadline(deadline.to_rmw_time()); }
  QoS& deadline(rmw_time_t deadline) { return set(profile_.deadline, deadline); }
  // Messages older than this are not delivered.
  QoS& lifespan(const Duration& lifespan) { return this->lifespan(lifespan.to_rmw_time()); }
  QoS& lifespan(rmw_time_t lifespan) { return set(profile_.lifespan, lifespan); }

  QoS& liveliness(LivelinessPolicy liveliness) {
    return this->liveliness(static_cast<rmw_qos_liveliness_policy_t>(liveliness));
  }
  QoS& liveliness(rmw_qos_liveliness_policy_t liveliness) { return set(profile_.liveliness, liveliness); }
  QoS& liveliness_lease_duration(const Duration& duration) { return liveliness_lease_duration(duration.to_rmw_time()); }
  QoS& liveliness_lease_duration(rmw_time_t duration) { return set(profile_.liveliness_lease_duration, duration); }

  QoS& avoid_ros_namespace_conventions(bool avoid) { return set(profile_.avoid_ros_namespace_conventions, avoid); }

  HistoryPolicy history() const { return static_cast<HistoryPolicy>(profile_.history); }
  size_t depth() const { return profile_.depth; }
  ReliabilityPolicy reliability() const { return static_cast<ReliabilityPolicy>(profile_.reliability); }
  DurabilityPolicy durability() const { return static_cast<DurabilityPolicy>(profile_.durability); }
  Duration deadline() const { return Duration::from_rmw_time(profile_.deadline); }
  Duration lifespan() const { return Duration::from_rmw_time(profile_.lifespan); }
  LivelinessPolicy liveliness() const { return static_cast<LivelinessPolicy>(profile_.liveliness); }
  Duration liveliness_lease_duration() const { return Duration::from_rmw_time(profile_.liveliness_lease_duration); }
  bool avoid_ros_namespace_conventions() const { return profile_.avoid_ros_namespace_conventions; }

 private:
  template <typename T>
  QoS& set(T& policy, T value) {
    policy = value;
    return *this;
  }

  rmw_qos_profile_t profile_;
};

bool operator==(const QoS& left, const QoS& right);
bool operator!=(const QoS& left, const QoS& right);

// The profiles of ROS 2 by name.
class ClockQoS : public QoS {
 public:
  explicit ClockQoS(const QoSInitialization& history = KeepLast(1));
};

// RELIABILITY_QOS_POLICY and so on; INVALID_QOS_POLICY for an invalid kind.
std::string qos_policy_name_from_kind(rmw_qos_policy_kind_t policy_kind);

class SensorDataQoS : public QoS {
 public:
  explicit SensorDataQoS(const QoSInitialization& history = KeepLast(5));
};

class ParametersQoS : public QoS {
 public:
  explicit ParametersQoS(const QoSInitialization& history = KeepLast(1000));
};

class ServicesQoS : public QoS {
 public:
  explicit ServicesQoS(const QoSInitialization& history = KeepLast(10));
};

class ParameterEventsQoS : public QoS {
 public:
  explicit ParameterEventsQoS(const QoSInitialization& history = KeepLast(1000));
};

class RosoutQoS : public QoS {
 public:
  explicit RosoutQoS(const QoSInitialization& history = KeepLast(1000));
};

// Every policy as the middleware has it by default.
class SystemDefaultsQoS : public QoS {
 public:
  explicit SystemDefaultsQoS(const QoSInitialization& history = KeepLast(RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT, false));
};

// Adapts to the endpoints found at creation.
class BestAvailableQoS : public QoS {
 public:
  explicit BestAvailableQoS(const QoSInitialization& history = KeepLast(10));
};

enum class QoSCompatibility {
  Ok = RMW_QOS_COMPATIBILITY_OK,
  Warning = RMW_QOS_COMPATIBILITY_WARNING,  // they may not match
  Error = RMW_QOS_COMPATIBILITY_ERROR,      // they will not match
};

struct QoSCheckCompatibleResult {
  QoSCompatibility compatibility;
  std::string reason;  // a sentence per problem
};

// Whether a publisher with the first reaches a subscription with the second. Throws exceptions::RCLError.
QoSCheckCompatibleResult qos_check_compatible(const QoS& publisher_qos, const QoS& subscription_qos);

}  // namespace rclcpp
