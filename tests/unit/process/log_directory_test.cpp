// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "launcher/process/output/output_router.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

TEST(LogDirectory, IsNamedAfterTimeHostAndProcess) {
  const TemporaryDirectory base;
  const LogDirectory log = LogDirectory::create(LogDirectory::choose({{"ROS_LOG_DIR", base.path()}}));
  const fs::path path = log.path;
  EXPECT_EQ(path.parent_path(), base.path());
  EXPECT_TRUE(fs::is_directory(path));
  EXPECT_THAT(path.filename().string(),
              testing::MatchesRegex("[0-9]{4}-[0-9]{2}-[0-9]{2}-[0-9]{2}-[0-9]{2}-[0-9]{2}-[0-9]{6}-.+-" +
                                    std::to_string(::getpid())));
  EXPECT_EQ(log.warning, "");
}

TEST(LogDirectory, IsWhatLatestPointsTo) {
  const TemporaryDirectory base;
  for (int i = 0; i < 2; ++i) {
    const LogDirectory log = LogDirectory::create(LogDirectory::choose({{"ROS_LOG_DIR", base.path()}}));
    EXPECT_EQ(fs::canonical(base.path() + "/latest"), fs::canonical(log.path));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(base.path()), fs::directory_iterator()), 3);
}

TEST(LogDirectory, LeavesALatestThatIsNoLink) {
  const TemporaryDirectory base;
  fs::create_directory(base.path() + "/latest");
  const LogDirectory log = LogDirectory::create(LogDirectory::choose({{"ROS_LOG_DIR", base.path()}}));
  EXPECT_EQ(log.warning, "'" + base.path() + "/latest' is not a symbolic link: it is left as it is");
  EXPECT_TRUE(fs::is_directory(log.path));
}

TEST(LogDirectory, FollowsRosHomeAndHome) {
  const TemporaryDirectory home;
  const auto parent = [](const std::map<std::string, std::string>& environment) {
    return fs::path(LogDirectory::create(LogDirectory::choose(environment)).path).parent_path();
  };
  EXPECT_EQ(parent({{"HOME", home.path()}}), home.path() + "/.ros/log");
  EXPECT_EQ(parent({{"HOME", home.path()}, {"ROS_LOG_DIR", ""}, {"ROS_HOME", ""}}), home.path() + "/.ros/log");
  EXPECT_EQ(parent({{"HOME", home.path()}, {"ROS_HOME", "~/robot"}}), home.path() + "/robot/log");
  EXPECT_EQ(parent({{"HOME", home.path()}, {"ROS_HOME", "/nowhere"}, {"ROS_LOG_DIR", "~/logs"}}),
            home.path() + "/logs");
}

TEST(LogDirectory, FailsClearlyWhenItCannotBeMade) {
  const TemporaryDirectory base;
  const std::string file = base.write("file", "");
  try {
    LogDirectory::create(LogDirectory::choose({{"ROS_LOG_DIR", file + "/log"}}));
    FAIL() << "it was made";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.what(),
              "cannot create the log directory '" + file + "/log' (ROS_LOG_DIR may name another one): Not a directory");
  }
}

}  // namespace
}  // namespace launch
