// SPDX-License-Identifier: Apache-2.0
#include "base/environment/home_directory.hpp"

#include <gtest/gtest.h>
#include <pwd.h>
#include <stdlib.h>
#include <unistd.h>

namespace launch {
namespace {

using Variables = std::map<std::string, std::string>;

std::string home_of_this_user() {
  const passwd* const user = ::getpwuid(::getuid());
  return user == nullptr ? "/" : user->pw_dir;
}

TEST(HomeDirectory, IsThatOfTheGivenEnvironment) {
  EXPECT_EQ(home_directory({{"HOME", "/home/me"}}), "/home/me");
}

TEST(HomeDirectory, IsThatOfThePasswordDatabaseWithoutTheVariable) {
  EXPECT_EQ(home_directory(Variables{}), home_of_this_user());
  EXPECT_EQ(home_directory({{"HOME", ""}}), home_of_this_user());
}

TEST(HomeDirectory, OfThisProcessFollowsItsOwnEnvironment) {
  ASSERT_EQ(::setenv("HOME", "/home/of/the/test", 1), 0);
  EXPECT_EQ(home_directory(), "/home/of/the/test");
  ASSERT_EQ(::unsetenv("HOME"), 0);
  EXPECT_EQ(home_directory(), home_of_this_user());
}

TEST(ExpandHome, ReplacesATildeThatStandsForTheHome) {
  const Variables environment = {{"HOME", "/home/me"}};
  EXPECT_EQ(expand_home("~", environment), "/home/me");
  EXPECT_EQ(expand_home("~/logs", environment), "/home/me/logs");
  EXPECT_EQ(expand_home("/a/~/b", environment), "/a/~/b");
  EXPECT_EQ(expand_home("~you/logs", environment), "~you/logs");
  EXPECT_EQ(expand_home("", environment), "");
}

TEST(RosHome, IsTheVariableOrDotRos) {
  EXPECT_EQ(ros_home({{"HOME", "/home/me"}}), "/home/me/.ros");
  EXPECT_EQ(ros_home({{"HOME", "/home/me"}, {"ROS_HOME", ""}}), "/home/me/.ros");
  EXPECT_EQ(ros_home({{"HOME", "/home/me"}, {"ROS_HOME", "~/robot"}}), "/home/me/robot");
  EXPECT_EQ(ros_home({{"ROS_HOME", "/ros"}}), "/ros");
}

TEST(RosLogDirectory, IsTheVariableOrInRosHome) {
  EXPECT_EQ(ros_log_directory({{"HOME", "/home/me"}}), "/home/me/.ros/log");
  EXPECT_EQ(ros_log_directory({{"HOME", "/home/me"}, {"ROS_HOME", "/ros"}, {"ROS_LOG_DIR", ""}}), "/ros/log");
  EXPECT_EQ(ros_log_directory({{"HOME", "/home/me"}, {"ROS_HOME", "/ros"}, {"ROS_LOG_DIR", "~/l"}}), "/home/me/l");
}

}  // namespace
}  // namespace launch
