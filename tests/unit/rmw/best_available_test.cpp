// SPDX-License-Identifier: Apache-2.0
// What "best available" comes to beside endpoints of all kinds.
#include "qos/best_available.hpp"

#include <gtest/gtest.h>

#include "rmw/qos_profiles.h"
#include "rmw/time.h"

namespace {

using rmw_fastrtps::best_available_for_publisher;
using rmw_fastrtps::best_available_for_service;
using rmw_fastrtps::best_available_for_subscription;
using rmw_fastrtps::GraphCache;

constexpr rmw_time_t kUnlimited = RMW_DURATION_INFINITE;
constexpr rmw_time_t kDefault = RMW_QOS_DEADLINE_DEFAULT;

// As discovery tells them: the profile of a new endpoint has its defaults filled in.
GraphCache::OwnedEndpoint endpoint(rmw_qos_reliability_policy_t reliability, rmw_qos_durability_policy_t durability,
                                   rmw_qos_liveliness_policy_t liveliness = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC,
                                   rmw_time_t deadline = kUnlimited, rmw_time_t lease = kUnlimited) {
  GraphCache::OwnedEndpoint owned{};
  owned.endpoint.qos = rmw_qos_profile_default;
  owned.endpoint.qos.reliability = reliability;
  owned.endpoint.qos.durability = durability;
  owned.endpoint.qos.liveliness = liveliness;
  owned.endpoint.qos.deadline = deadline;
  owned.endpoint.qos.liveliness_lease_duration = lease;
  return owned;
}

const auto kStrict = endpoint(RMW_QOS_POLICY_RELIABILITY_RELIABLE, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
                              RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC, {0, 5'000'000}, {1, 0});
const auto kLoose = endpoint(RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, RMW_QOS_POLICY_DURABILITY_VOLATILE,
                             RMW_QOS_POLICY_LIVELINESS_AUTOMATIC, {2, 0}, {3, 0});

#define EXPECT_DURATION(actual, expected)       \
  EXPECT_TRUE(rmw_time_equal(actual, expected)) \
      << actual.sec << " s " << actual.nsec << " ns instead of " << expected.sec << " s " << expected.nsec << " ns"

TEST(BestAvailable, IsTheStrictestForASubscriptionWithoutPublishers) {
  const rmw_qos_profile_t result = best_available_for_subscription(rmw_qos_profile_best_available, {});
  EXPECT_EQ(result.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(result.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(result.liveliness, RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC);
  EXPECT_DURATION(result.deadline, kDefault);
  EXPECT_DURATION(result.liveliness_lease_duration, kDefault);
  EXPECT_EQ(result.history, RMW_QOS_POLICY_HISTORY_KEEP_LAST);
  EXPECT_EQ(result.depth, 10u);
}

TEST(BestAvailable, IsAsStrictAsAllPublishersOffer) {
  const rmw_qos_profile_t one = best_available_for_subscription(rmw_qos_profile_best_available, {kStrict});
  EXPECT_EQ(one.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(one.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(one.liveliness, RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC);
  EXPECT_DURATION(one.deadline, kStrict.endpoint.qos.deadline);
  EXPECT_DURATION(one.liveliness_lease_duration, kStrict.endpoint.qos.liveliness_lease_duration);

  const rmw_qos_profile_t two = best_available_for_subscription(rmw_qos_profile_best_available, {kStrict, kLoose});
  EXPECT_EQ(two.reliability, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT);
  EXPECT_EQ(two.durability, RMW_QOS_POLICY_DURABILITY_VOLATILE);
  EXPECT_EQ(two.liveliness, RMW_QOS_POLICY_LIVELINESS_AUTOMATIC);
  EXPECT_DURATION(two.deadline, kLoose.endpoint.qos.deadline);
  EXPECT_DURATION(two.liveliness_lease_duration, kLoose.endpoint.qos.liveliness_lease_duration);
}

TEST(BestAvailable, HasNoDeadlineIfAPublisherHasNone) {
  const auto unlimited = endpoint(RMW_QOS_POLICY_RELIABILITY_RELIABLE, RMW_QOS_POLICY_DURABILITY_VOLATILE);
  const rmw_qos_profile_t result =
      best_available_for_subscription(rmw_qos_profile_best_available, {kStrict, unlimited});
  EXPECT_DURATION(result.deadline, kDefault);
  EXPECT_DURATION(result.liveliness_lease_duration, kDefault);
}

TEST(BestAvailable, OffersAllThatAPublisherCan) {
  const rmw_qos_profile_t alone = best_available_for_publisher(rmw_qos_profile_best_available, {});
  EXPECT_EQ(alone.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(alone.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(alone.liveliness, RMW_QOS_POLICY_LIVELINESS_AUTOMATIC);
  EXPECT_DURATION(alone.deadline, kDefault);

  const rmw_qos_profile_t result = best_available_for_publisher(rmw_qos_profile_best_available, {kLoose, kStrict});
  EXPECT_EQ(result.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(result.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(result.liveliness, RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC);
  EXPECT_DURATION(result.deadline, kStrict.endpoint.qos.deadline);
  EXPECT_DURATION(result.liveliness_lease_duration, kStrict.endpoint.qos.liveliness_lease_duration);
}

TEST(BestAvailable, LeavesOtherPoliciesAlone) {
  rmw_qos_profile_t profile = rmw_qos_profile_sensor_data;
  EXPECT_FALSE(rmw_fastrtps::asks_for_best_available(profile));
  profile.durability = RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE;
  EXPECT_TRUE(rmw_fastrtps::asks_for_best_available(profile));
  const rmw_qos_profile_t result = best_available_for_subscription(profile, {kStrict});
  EXPECT_EQ(result.reliability, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT);
  EXPECT_EQ(result.durability, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
  EXPECT_EQ(result.depth, 5u);
  EXPECT_DURATION(result.deadline, kDefault);
}

TEST(BestAvailable, IsTheDefaultForServices) {
  const rmw_qos_profile_t result = best_available_for_service(rmw_qos_profile_best_available);
  EXPECT_EQ(result.reliability, RMW_QOS_POLICY_RELIABILITY_RELIABLE);
  EXPECT_EQ(result.durability, RMW_QOS_POLICY_DURABILITY_VOLATILE);
  EXPECT_EQ(result.liveliness, RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT);
  EXPECT_DURATION(result.deadline, kDefault);
  EXPECT_DURATION(result.liveliness_lease_duration, kDefault);
}

}  // namespace
