// SPDX-License-Identifier: Apache-2.0
#include "qos/best_available.hpp"

#include <algorithm>

#include "rmw/qos_profiles.h"
#include "rmw/time.h"

namespace rmw_fastrtps {
namespace {

using Endpoints = std::vector<GraphCache::OwnedEndpoint>;
using Duration = rmw_time_t rmw_qos_profile_t::*;

constexpr rmw_time_t kNoLimit = RMW_DURATION_INFINITE;
constexpr rmw_time_t kBestDeadline = RMW_QOS_DEADLINE_BEST_AVAILABLE;
constexpr rmw_time_t kDefaultDeadline = RMW_QOS_DEADLINE_DEFAULT;
constexpr rmw_time_t kBestLease = RMW_QOS_LIVELINESS_LEASE_DURATION_BEST_AVAILABLE;
constexpr rmw_time_t kDefaultLease = RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT;

bool less(const rmw_time_t& left, const rmw_time_t& right) {
  return rmw_time_total_nsec(left) < rmw_time_total_nsec(right);
}

// `otherwise` if nobody limits this duration.
rmw_time_t largest(const Endpoints& endpoints, Duration duration, const rmw_time_t& otherwise) {
  const auto found =
      std::ranges::max_element(endpoints, less, [duration](const auto& owned) { return owned.endpoint.qos.*duration; });
  const bool limited = found != endpoints.end() && !rmw_time_equal(found->endpoint.qos.*duration, kNoLimit);
  return limited ? found->endpoint.qos.*duration : otherwise;
}

rmw_time_t smallest(const Endpoints& endpoints, Duration duration, const rmw_time_t& otherwise) {
  const auto found =
      std::ranges::min_element(endpoints, less, [duration](const auto& owned) { return owned.endpoint.qos.*duration; });
  const bool limited = found != endpoints.end() && !rmw_time_equal(found->endpoint.qos.*duration, kNoLimit);
  return limited ? found->endpoint.qos.*duration : otherwise;
}

}  // namespace

bool asks_for_best_available(const rmw_qos_profile_t& profile) {
  return profile.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE ||
         profile.durability == RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE ||
         profile.liveliness == RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE ||
         rmw_time_equal(profile.deadline, kBestDeadline) ||
         rmw_time_equal(profile.liveliness_lease_duration, kBestLease);
}

rmw_qos_profile_t best_available_for_subscription(const rmw_qos_profile_t& profile, const Endpoints& publishers) {
  const auto all = [&publishers](auto policy, auto value) {
    return std::ranges::all_of(publishers, [&](const auto& owned) { return owned.endpoint.qos.*policy == value; });
  };
  rmw_qos_profile_t result = profile;
  if (profile.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE) {
    result.reliability = all(&rmw_qos_profile_t::reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE)
                             ? RMW_QOS_POLICY_RELIABILITY_RELIABLE
                             : RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  }
  if (profile.durability == RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE) {
    result.durability = all(&rmw_qos_profile_t::durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL)
                            ? RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL
                            : RMW_QOS_POLICY_DURABILITY_VOLATILE;
  }
  if (profile.liveliness == RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE) {
    result.liveliness = all(&rmw_qos_profile_t::liveliness, RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC)
                            ? RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC
                            : RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;
  }
  if (rmw_time_equal(profile.deadline, kBestDeadline)) {
    result.deadline = largest(publishers, &rmw_qos_profile_t::deadline, kDefaultDeadline);
  }
  if (rmw_time_equal(profile.liveliness_lease_duration, kBestLease)) {
    result.liveliness_lease_duration =
        largest(publishers, &rmw_qos_profile_t::liveliness_lease_duration, kDefaultLease);
  }
  return result;
}

rmw_qos_profile_t best_available_for_publisher(const rmw_qos_profile_t& profile, const Endpoints& subscriptions) {
  rmw_qos_profile_t result = profile;
  if (profile.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE) {
    result.reliability = RMW_QOS_POLICY_RELIABILITY_RELIABLE;
  }
  if (profile.durability == RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE) {
    result.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  }
  if (profile.liveliness == RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE) {
    const bool manual = std::ranges::any_of(subscriptions, [](const auto& owned) {
      return owned.endpoint.qos.liveliness == RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
    });
    result.liveliness = manual ? RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC : RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;
  }
  if (rmw_time_equal(profile.deadline, kBestDeadline)) {
    result.deadline = smallest(subscriptions, &rmw_qos_profile_t::deadline, kDefaultDeadline);
  }
  if (rmw_time_equal(profile.liveliness_lease_duration, kBestLease)) {
    result.liveliness_lease_duration =
        smallest(subscriptions, &rmw_qos_profile_t::liveliness_lease_duration, kDefaultLease);
  }
  return result;
}

rmw_qos_profile_t best_available_for_service(const rmw_qos_profile_t& profile) {
  rmw_qos_profile_t result = profile;
  if (profile.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE) {
    result.reliability = rmw_qos_profile_services_default.reliability;
  }
  if (profile.durability == RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE) {
    result.durability = rmw_qos_profile_services_default.durability;
  }
  if (profile.liveliness == RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE) {
    result.liveliness = rmw_qos_profile_services_default.liveliness;
  }
  if (rmw_time_equal(profile.deadline, kBestDeadline)) {
    result.deadline = rmw_qos_profile_services_default.deadline;
  }
  if (rmw_time_equal(profile.liveliness_lease_duration, kBestLease)) {
    result.liveliness_lease_duration = rmw_qos_profile_services_default.liveliness_lease_duration;
  }
  return result;
}

}  // namespace rmw_fastrtps
