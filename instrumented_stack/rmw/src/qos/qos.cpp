// SPDX-License-Identifier: Apache-2.0
#include "qos/qos.hpp"

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <limits>
#include <stdexcept>

#include "fastdds_versions/discovery_listener.hpp"

namespace rmw_fastrtps {
namespace {

constexpr rmw_time_t kUnspecified = RMW_DURATION_UNSPECIFIED;
constexpr rmw_time_t kInfinite = RMW_DURATION_INFINITE;

rmw_time_t from_dds(const DdsDuration& duration) {
  if (duration.is_infinite()) {
    return kInfinite;
  }
  return {static_cast<std::uint64_t>(duration.seconds), duration.nanosec};
}

[[noreturn]] void refuse(const char* policy, const char* value) {
  throw std::runtime_error(std::string(policy) + " '" + value + "' cannot be asked for");
}

template <typename Qos>
void apply(const rmw_qos_profile_t& profile, Qos& qos) {
  switch (profile.history) {
    case RMW_QOS_POLICY_HISTORY_KEEP_LAST:
      qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
      break;
    case RMW_QOS_POLICY_HISTORY_KEEP_ALL:
      qos.history().kind = fdds::KEEP_ALL_HISTORY_QOS;
      break;
    case RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT:
      break;
    default:
      refuse("history", "unknown");
  }
  if (profile.depth > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw std::runtime_error("history depth " + std::to_string(profile.depth) + " is more than Fast DDS can keep");
  }
  if (profile.depth != RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT) {
    qos.history().depth = static_cast<std::int32_t>(profile.depth);
  }

  switch (profile.reliability) {
    case RMW_QOS_POLICY_RELIABILITY_RELIABLE:
      qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
      break;
    case RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT:
      qos.reliability().kind = fdds::BEST_EFFORT_RELIABILITY_QOS;
      break;
    case RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT:
      break;
    case RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE:
      refuse("reliability", "best available");
    default:
      refuse("reliability", "unknown");
  }

  switch (profile.durability) {
    case RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL:
      qos.durability().kind = fdds::TRANSIENT_LOCAL_DURABILITY_QOS;
      break;
    case RMW_QOS_POLICY_DURABILITY_VOLATILE:
      qos.durability().kind = fdds::VOLATILE_DURABILITY_QOS;
      break;
    case RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT:
      break;
    case RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE:
      refuse("durability", "best available");
    default:
      refuse("durability", "unknown");
  }

  switch (profile.liveliness) {
    case RMW_QOS_POLICY_LIVELINESS_AUTOMATIC:
      qos.liveliness().kind = fdds::AUTOMATIC_LIVELINESS_QOS;
      break;
    case RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC:
      qos.liveliness().kind = fdds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
      break;
    case RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT:
      break;
    case RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE:
      refuse("liveliness", "best available");
    default:
      refuse("liveliness", "unknown");
  }

  if (!rmw_time_equal(profile.deadline, kUnspecified)) {
    qos.deadline().period = to_dds(profile.deadline);
  }
  if (!rmw_time_equal(profile.lifespan, kUnspecified)) {
    qos.lifespan().duration = to_dds(profile.lifespan);
  }
  if (!rmw_time_equal(profile.liveliness_lease_duration, kUnspecified)) {
    qos.liveliness().lease_duration = to_dds(profile.liveliness_lease_duration);
    // Announce often enough that one lost announcement does not end the lease.
    const double period = static_cast<double>(rmw_time_total_nsec(profile.liveliness_lease_duration)) * 2.0 / 3.0;
    qos.liveliness().announcement_period = to_dds(rmw_time_from_nsec(static_cast<rmw_duration_t>(period)));
  }
}

// The profile from the policies that endpoints announce, and that they know of themselves.
rmw_qos_profile_t profile_from(const fdds::ReliabilityQosPolicy& reliability,
                               const fdds::DurabilityQosPolicy& durability, const fdds::LivelinessQosPolicy& liveliness,
                               const fdds::DeadlineQosPolicy& deadline) {
  rmw_qos_profile_t profile{};
  profile.history = RMW_QOS_POLICY_HISTORY_UNKNOWN;
  profile.reliability = reliability.kind == fdds::RELIABLE_RELIABILITY_QOS ? RMW_QOS_POLICY_RELIABILITY_RELIABLE
                                                                           : RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  profile.durability = durability.kind == fdds::VOLATILE_DURABILITY_QOS ? RMW_QOS_POLICY_DURABILITY_VOLATILE
                       : durability.kind == fdds::TRANSIENT_LOCAL_DURABILITY_QOS
                           ? RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL
                           : RMW_QOS_POLICY_DURABILITY_UNKNOWN;
  profile.liveliness = liveliness.kind == fdds::AUTOMATIC_LIVELINESS_QOS ? RMW_QOS_POLICY_LIVELINESS_AUTOMATIC
                       : liveliness.kind == fdds::MANUAL_BY_TOPIC_LIVELINESS_QOS
                           ? RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC
                           : RMW_QOS_POLICY_LIVELINESS_UNKNOWN;
  profile.deadline = from_dds(deadline.period);
  profile.lifespan = kInfinite;
  profile.liveliness_lease_duration = from_dds(liveliness.lease_duration);
  return profile;
}

template <typename Qos>
rmw_qos_profile_t profile_from(const Qos& qos) {
  rmw_qos_profile_t profile = profile_from(qos.reliability(), qos.durability(), qos.liveliness(), qos.deadline());
  profile.history = qos.history().kind == fdds::KEEP_LAST_HISTORY_QOS ? RMW_QOS_POLICY_HISTORY_KEEP_LAST
                                                                      : RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  profile.depth = static_cast<std::size_t>(qos.history().depth);
  profile.lifespan = from_dds(qos.lifespan().duration);
  return profile;
}

}  // namespace

DdsDuration to_dds(const rmw_time_t& time) {
  const rmw_duration_t total = rmw_time_total_nsec(time);
  const rmw_time_t normal = rmw_time_from_nsec(total);
  if (total == std::numeric_limits<rmw_duration_t>::max() || normal.sec > std::numeric_limits<std::int32_t>::max()) {
    return kInfiniteDuration;
  }
  return DdsDuration(static_cast<std::int32_t>(normal.sec), static_cast<std::uint32_t>(normal.nsec));
}

void apply_profile(const rmw_qos_profile_t& profile, fdds::DataWriterQos& qos) {
  apply(profile, qos);
}
void apply_profile(const rmw_qos_profile_t& profile, fdds::DataReaderQos& qos) {
  apply(profile, qos);
}
rmw_qos_profile_t profile_of(const fdds::DataWriterQos& qos) {
  return profile_from(qos);
}
rmw_qos_profile_t profile_of(const fdds::DataReaderQos& qos) {
  return profile_from(qos);
}
rmw_qos_profile_t profile_of(const FoundEndpoint& endpoint) {
  rmw_qos_profile_t profile =
      profile_from(endpoint.reliability, endpoint.durability, endpoint.liveliness, endpoint.deadline);
  if (endpoint.lifespan != nullptr) {
    profile.lifespan = from_dds(endpoint.lifespan->duration);
  }
  return profile;
}

}  // namespace rmw_fastrtps
