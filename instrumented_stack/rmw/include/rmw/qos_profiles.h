// SPDX-License-Identifier: Apache-2.0
// Quality-of-service profiles of ROS 2 and the check whether two profiles match.
#pragma once

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

static const rmw_qos_profile_t rmw_qos_profile_sensor_data = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                              5,
                                                              RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
                                                              RMW_QOS_POLICY_DURABILITY_VOLATILE,
                                                              RMW_QOS_DEADLINE_DEFAULT,
                                                              RMW_QOS_LIFESPAN_DEFAULT,
                                                              RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                              RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                              false};

static const rmw_qos_profile_t rmw_qos_profile_parameters = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                             1000,
                                                             RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                                                             RMW_QOS_POLICY_DURABILITY_VOLATILE,
                                                             RMW_QOS_DEADLINE_DEFAULT,
                                                             RMW_QOS_LIFESPAN_DEFAULT,
                                                             RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                             RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                             false};

static const rmw_qos_profile_t rmw_qos_profile_default = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                          10,
                                                          RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                                                          RMW_QOS_POLICY_DURABILITY_VOLATILE,
                                                          RMW_QOS_DEADLINE_DEFAULT,
                                                          RMW_QOS_LIFESPAN_DEFAULT,
                                                          RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                          RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                          false};

static const rmw_qos_profile_t rmw_qos_profile_services_default = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                                   10,
                                                                   RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                                                                   RMW_QOS_POLICY_DURABILITY_VOLATILE,
                                                                   RMW_QOS_DEADLINE_DEFAULT,
                                                                   RMW_QOS_LIFESPAN_DEFAULT,
                                                                   RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                                   RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                                   false};

static const rmw_qos_profile_t rmw_qos_profile_parameter_events = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                                   1000,
                                                                   RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                                                                   RMW_QOS_POLICY_DURABILITY_VOLATILE,
                                                                   RMW_QOS_DEADLINE_DEFAULT,
                                                                   RMW_QOS_LIFESPAN_DEFAULT,
                                                                   RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                                   RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                                   false};

// /rosout: late joiners get the messages of the last ten seconds.
static const rmw_qos_profile_t rmw_qos_profile_rosout_default = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                                 1000,
                                                                 RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                                                                 RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
                                                                 RMW_QOS_DEADLINE_DEFAULT,
                                                                 {10, 0},
                                                                 RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                                 RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                                 false};

// Every policy as the middleware has it by default.
static const rmw_qos_profile_t rmw_qos_profile_system_default = {RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT,
                                                                 RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT,
                                                                 RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT,
                                                                 RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT,
                                                                 RMW_QOS_DEADLINE_DEFAULT,
                                                                 RMW_QOS_LIFESPAN_DEFAULT,
                                                                 RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
                                                                 RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                                 false};

// What most of the publishers or subscriptions that are there can match, and as strict as that permits.
static const rmw_qos_profile_t rmw_qos_profile_best_available = {RMW_QOS_POLICY_HISTORY_KEEP_LAST,
                                                                 10,
                                                                 RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE,
                                                                 RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE,
                                                                 RMW_QOS_DEADLINE_BEST_AVAILABLE,
                                                                 RMW_QOS_LIFESPAN_DEFAULT,
                                                                 RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE,
                                                                 RMW_QOS_LIVELINESS_LEASE_DURATION_BEST_AVAILABLE,
                                                                 false};

static const rmw_qos_profile_t rmw_qos_profile_unknown = {RMW_QOS_POLICY_HISTORY_UNKNOWN,
                                                          RMW_QOS_POLICY_DEPTH_SYSTEM_DEFAULT,
                                                          RMW_QOS_POLICY_RELIABILITY_UNKNOWN,
                                                          RMW_QOS_POLICY_DURABILITY_UNKNOWN,
                                                          RMW_QOS_DEADLINE_DEFAULT,
                                                          RMW_QOS_LIFESPAN_DEFAULT,
                                                          RMW_QOS_POLICY_LIVELINESS_UNKNOWN,
                                                          RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT,
                                                          false};

typedef enum rmw_qos_compatibility_type_e {
  RMW_QOS_COMPATIBILITY_OK = 0,
  RMW_QOS_COMPATIBILITY_WARNING,  // a policy is unknown or left to the middleware: they may not match
  RMW_QOS_COMPATIBILITY_ERROR,    // they will not match
} rmw_qos_compatibility_type_t;

// Whether a publisher with the first profile reaches a subscription with the second. `reason` (may be null) gets one
// sentence per problem, cut to `reason_size` bytes.
rmw_ret_t rmw_qos_profile_check_compatible(const rmw_qos_profile_t publisher_profile,
                                           const rmw_qos_profile_t subscription_profile,
                                           rmw_qos_compatibility_type_t* compatibility, char* reason,
                                           size_t reason_size);

#ifdef __cplusplus
}
#endif
