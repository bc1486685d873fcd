// SPDX-License-Identifier: Apache-2.0
// The parts of rmw that need no middleware: names, compatibility of profiles, time.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include "rmw/qos_profiles.h"
#include "rmw/validate_full_topic_name.h"
#include "rmw/validate_namespace.h"
#include "rmw/validate_node_name.h"

namespace {

struct Name {
  std::string name;
  int result;
  size_t index;
};

std::ostream& operator<<(std::ostream& out, const Name& name) {
  return out << '\'' << name.name << '\'';
}

class FullTopicName : public testing::TestWithParam<Name> {};

TEST_P(FullTopicName, IsChecked) {
  int result = -1;
  size_t index = 0;
  ASSERT_EQ(rmw_validate_full_topic_name(GetParam().name.c_str(), &result, &index), RMW_RET_OK);
  EXPECT_EQ(result, GetParam().result);
  EXPECT_EQ(index, GetParam().index);
  EXPECT_EQ(rmw_full_topic_name_validation_result_string(result) == nullptr, result == RMW_TOPIC_VALID);
}

INSTANTIATE_TEST_SUITE_P(Vectors, FullTopicName,
                         testing::Values(Name{"/chatter", RMW_TOPIC_VALID, 0}, Name{"/a/b_1/c", RMW_TOPIC_VALID, 0},
                                         Name{"", RMW_TOPIC_INVALID_IS_EMPTY_STRING, 0},
                                         Name{"chatter", RMW_TOPIC_INVALID_NOT_ABSOLUTE, 0},
                                         Name{"/", RMW_TOPIC_INVALID_ENDS_WITH_FORWARD_SLASH, 0},
                                         Name{"/a/", RMW_TOPIC_INVALID_ENDS_WITH_FORWARD_SLASH, 2},
                                         Name{"/a b", RMW_TOPIC_INVALID_CONTAINS_UNALLOWED_CHARACTERS, 2},
                                         Name{"/~", RMW_TOPIC_INVALID_CONTAINS_UNALLOWED_CHARACTERS, 1},
                                         Name{"/a//b", RMW_TOPIC_INVALID_CONTAINS_REPEATED_FORWARD_SLASH, 3},
                                         Name{"/a/2b", RMW_TOPIC_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, 3},
                                         Name{"/" + std::string(246, 'a'), RMW_TOPIC_VALID, 0},
                                         Name{"/" + std::string(247, 'a'), RMW_TOPIC_INVALID_TOO_LONG, 246}));

TEST(Namespace, MayBeTheRootAndIsElseATopicName) {
  int result = -1;
  ASSERT_EQ(rmw_validate_namespace("/", &result, nullptr), RMW_RET_OK);
  EXPECT_EQ(result, RMW_NAMESPACE_VALID);
  ASSERT_EQ(rmw_validate_namespace("/a/b", &result, nullptr), RMW_RET_OK);
  EXPECT_EQ(result, RMW_NAMESPACE_VALID);
  ASSERT_EQ(rmw_validate_namespace("a", &result, nullptr), RMW_RET_OK);
  EXPECT_EQ(result, RMW_NAMESPACE_INVALID_NOT_ABSOLUTE);
}

TEST(NodeName, HasLettersDigitsAndUnderscores) {
  const auto check = [](const std::string& name) {
    int result = -1;
    EXPECT_EQ(rmw_validate_node_name(name.c_str(), &result, nullptr), RMW_RET_OK);
    return result;
  };
  EXPECT_EQ(check("_talker_1"), RMW_NODE_NAME_VALID);
  EXPECT_EQ(check(""), RMW_NODE_NAME_INVALID_IS_EMPTY_STRING);
  EXPECT_EQ(check("a/b"), RMW_NODE_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS);
  EXPECT_EQ(check("1a"), RMW_NODE_NAME_INVALID_STARTS_WITH_NUMBER);
  EXPECT_EQ(check(std::string(256, 'a')), RMW_NODE_NAME_INVALID_TOO_LONG);
}

TEST(Time, ConvertsAndSaturates) {
  EXPECT_EQ(rmw_time_total_nsec({1, 5}), 1000000005);
  EXPECT_EQ(rmw_time_total_nsec(RMW_DURATION_INFINITE), std::numeric_limits<rmw_duration_t>::max());
  EXPECT_EQ(rmw_time_total_nsec({UINT64_MAX, UINT64_MAX}), std::numeric_limits<rmw_duration_t>::max());
  EXPECT_TRUE(rmw_time_equal(rmw_time_from_nsec(2500000000), {2, 500000000}));
  EXPECT_TRUE(rmw_time_equal(rmw_time_from_nsec(-1), RMW_DURATION_INFINITE));
  EXPECT_TRUE(rmw_time_equal({0, 1000000000}, {1, 0}));
}

// A changed copy of the default profile.
template <typename Change>
rmw_qos_profile_t profile(Change change) {
  rmw_qos_profile_t result = rmw_qos_profile_default;
  result.liveliness = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;
  change(result);
  return result;
}

struct Compatibility {
  rmw_qos_profile_t publisher;
  rmw_qos_profile_t subscription;
  rmw_qos_compatibility_type_t expected;
  const char* reason;
};

std::ostream& operator<<(std::ostream& out, const Compatibility& c) {
  return out << c.reason;
}

class QosCompatibility : public testing::TestWithParam<Compatibility> {};

TEST_P(QosCompatibility, IsToldWithTheReason) {
  rmw_qos_compatibility_type_t compatibility;
  char reason[256];
  ASSERT_EQ(rmw_qos_profile_check_compatible(GetParam().publisher, GetParam().subscription, &compatibility, reason,
                                             sizeof(reason)),
            RMW_RET_OK);
  EXPECT_EQ(compatibility, GetParam().expected);
  EXPECT_STREQ(reason, GetParam().reason);
}

const rmw_qos_profile_t kDefault = profile([](auto&) {});
const rmw_qos_profile_t kBestEffort =
    profile([](auto& qos) { qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT; });
const rmw_qos_profile_t kTransientLocal =
    profile([](auto& qos) { qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL; });
const rmw_qos_profile_t kDeadline = profile([](auto& qos) { qos.deadline = {1, 0}; });
const rmw_qos_profile_t kLongDeadline = profile([](auto& qos) { qos.deadline = {2, 0}; });
const rmw_qos_profile_t kManual =
    profile([](auto& qos) { qos.liveliness = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC; });
const rmw_qos_profile_t kLease = profile([](auto& qos) { qos.liveliness_lease_duration = {1, 0}; });
const rmw_qos_profile_t kOpen = profile([](auto& qos) { qos.reliability = RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT; });

INSTANTIATE_TEST_SUITE_P(
    Vectors, QosCompatibility,
    testing::Values(Compatibility{kDefault, kDefault, RMW_QOS_COMPATIBILITY_OK, ""},
                    Compatibility{kDefault, kBestEffort, RMW_QOS_COMPATIBILITY_OK, ""},
                    Compatibility{kBestEffort, kDefault, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: best effort publisher and reliable subscription;"},
                    Compatibility{kTransientLocal, kDefault, RMW_QOS_COMPATIBILITY_OK, ""},
                    Compatibility{kDefault, kTransientLocal, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: volatile publisher and transient local subscription;"},
                    Compatibility{kDeadline, kLongDeadline, RMW_QOS_COMPATIBILITY_OK, ""},
                    Compatibility{kDeadline, kDefault, RMW_QOS_COMPATIBILITY_OK, ""},
                    Compatibility{kLongDeadline, kDeadline, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: subscription's deadline is shorter than publisher's;"},
                    Compatibility{kDefault, kDeadline, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: subscription has a deadline and publisher has none;"},
                    Compatibility{kDefault, kManual, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: publisher's liveliness is automatic and subscription's is manual by topic;"},
                    Compatibility{kDefault, kLease, RMW_QOS_COMPATIBILITY_ERROR,
                                  "ERROR: subscription has a liveliness lease duration and publisher has none;"},
                    Compatibility{
                        kOpen, kDefault, RMW_QOS_COMPATIBILITY_WARNING,
                        "WARNING: reliability is left open: a best effort publisher does not match a reliable "
                        "subscription;"}));

}  // namespace
