// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <test_msgs/message_fixtures.hpp>

TEST(Domain, IsTheTestsOwn) {
  const char* const domain = std::getenv("ROS_DOMAIN_ID");
  ASSERT_NE(domain, nullptr);
  EXPECT_GE(std::stoi(domain), 1);
  EXPECT_LE(std::stoi(domain), 101);
  EXPECT_STREQ(std::getenv("OF_TEST"), "set");
  EXPECT_EQ(get_messages_basic_types().size(), 4U);
}
