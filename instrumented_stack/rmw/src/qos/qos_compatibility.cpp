// SPDX-License-Identifier: Apache-2.0
// Whether two profiles match: the request-versus-offer rules of the DDS specification, 2.2.3.
#include <cstdio>
#include <string>

#include "rmw/error_handling.h"
#include "rmw/qos_profiles.h"

namespace {

constexpr rmw_time_t kUnspecified = RMW_DURATION_UNSPECIFIED;

// Collects sentences; the text has errors before warnings.
struct Findings {
  std::string errors;
  std::string warnings;

  void error(const char* sentence) { errors.append("ERROR: ").append(sentence).append(";"); }
  void warning(const char* sentence) { warnings.append("WARNING: ").append(sentence).append(";"); }
};

template <typename Policy>
bool is_open(Policy policy, Policy system_default, Policy unknown) {
  return policy == system_default || policy == unknown;
}

void compare_reliability(const rmw_qos_profile_t& publisher, const rmw_qos_profile_t& subscription,
                         Findings& findings) {
  const bool publisher_open =
      is_open(publisher.reliability, RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT, RMW_QOS_POLICY_RELIABILITY_UNKNOWN);
  const bool subscription_open =
      is_open(subscription.reliability, RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT, RMW_QOS_POLICY_RELIABILITY_UNKNOWN);
  const bool best_effort = publisher.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  const bool reliable = subscription.reliability == RMW_QOS_POLICY_RELIABILITY_RELIABLE;
  if (best_effort && reliable) {
    findings.error("best effort publisher and reliable subscription");
  } else if ((best_effort && subscription_open) || (publisher_open && reliable) ||
             (publisher_open && subscription_open)) {
    findings.warning("reliability is left open: a best effort publisher does not match a reliable subscription");
  }
}

void compare_durability(const rmw_qos_profile_t& publisher, const rmw_qos_profile_t& subscription, Findings& findings) {
  const bool publisher_open =
      is_open(publisher.durability, RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT, RMW_QOS_POLICY_DURABILITY_UNKNOWN);
  const bool subscription_open =
      is_open(subscription.durability, RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT, RMW_QOS_POLICY_DURABILITY_UNKNOWN);
  const bool is_volatile = publisher.durability == RMW_QOS_POLICY_DURABILITY_VOLATILE;
  const bool transient = subscription.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  if (is_volatile && transient) {
    findings.error("volatile publisher and transient local subscription");
  } else if ((is_volatile && subscription_open) || (publisher_open && transient) ||
             (publisher_open && subscription_open)) {
    findings.warning("durability is left open: a volatile publisher does not match a transient local subscription");
  }
}

// `offered` must be at most `requested`; unspecified means infinite.
void compare_durations(rmw_time_t offered, rmw_time_t requested, const char* without, const char* greater,
                       Findings& findings) {
  if (rmw_time_equal(requested, kUnspecified)) {
    return;
  }
  if (rmw_time_equal(offered, kUnspecified)) {
    findings.error(without);
  } else if (rmw_time_total_nsec(offered) > rmw_time_total_nsec(requested)) {
    findings.error(greater);
  }
}

void compare_liveliness(const rmw_qos_profile_t& publisher, const rmw_qos_profile_t& subscription, Findings& findings) {
  const bool publisher_open =
      is_open(publisher.liveliness, RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, RMW_QOS_POLICY_LIVELINESS_UNKNOWN);
  const bool subscription_open =
      is_open(subscription.liveliness, RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, RMW_QOS_POLICY_LIVELINESS_UNKNOWN);
  const bool automatic = publisher.liveliness == RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;
  const bool manual = subscription.liveliness == RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
  if (automatic && manual) {
    findings.error("publisher's liveliness is automatic and subscription's is manual by topic");
  } else if ((automatic && subscription_open) || (publisher_open && manual) || (publisher_open && subscription_open)) {
    findings.warning("liveliness is left open: automatic does not match manual by topic");
  }
}

}  // namespace

rmw_ret_t rmw_qos_profile_check_compatible(const rmw_qos_profile_t publisher_profile,
                                           const rmw_qos_profile_t subscription_profile,
                                           rmw_qos_compatibility_type_t* compatibility, char* reason,
                                           size_t reason_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(compatibility, RMW_RET_INVALID_ARGUMENT);
  if (reason == nullptr && reason_size != 0) {
    RMW_SET_ERROR_MSG("reason is null but its size is not 0");
    return RMW_RET_INVALID_ARGUMENT;
  }
  Findings findings;
  compare_reliability(publisher_profile, subscription_profile, findings);
  compare_durability(publisher_profile, subscription_profile, findings);
  compare_durations(publisher_profile.deadline, subscription_profile.deadline,
                    "subscription has a deadline and publisher has none",
                    "subscription's deadline is shorter than publisher's", findings);
  compare_liveliness(publisher_profile, subscription_profile, findings);
  compare_durations(publisher_profile.liveliness_lease_duration, subscription_profile.liveliness_lease_duration,
                    "subscription has a liveliness lease duration and publisher has none",
                    "subscription's liveliness lease duration is shorter than publisher's", findings);
  *compatibility = !findings.errors.empty()     ? RMW_QOS_COMPATIBILITY_ERROR
                   : !findings.warnings.empty() ? RMW_QOS_COMPATIBILITY_WARNING
                                                : RMW_QOS_COMPATIBILITY_OK;
  if (reason != nullptr && reason_size != 0) {
    std::snprintf(reason, reason_size, "%s%s", findings.errors.c_str(), findings.warnings.c_str());
  }
  return RMW_RET_OK;
}
