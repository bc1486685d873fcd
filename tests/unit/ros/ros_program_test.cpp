// SPDX-License-Identifier: Apache-2.0
// Which program asks nodes: that of launch_companion in the environment, or the one of this installation.
#include "launcher/ros/ros_program.hpp"

#include <gmock/gmock.h>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_prefix.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

class RosProgram : public testing::Test {
 protected:
  // A prefix with a companion of this version.
  fs::path companion(const std::string& name, const std::string& version) const {
    const fs::path prefix = sandbox_.directory() / name;
    fs::create_directories(prefix / "lib/launch_companion");
    fs::create_directories(prefix / "share/launch_companion");
    test_support::write_file(prefix / "share/launch_companion/version", version);
    return prefix;
  }

  static std::string error_of(const Environment& environment) {
    try {
      return "no error: " + ros_program("launch-ros-client", environment);
    } catch (const LaunchError& error) {
      return error.what();
    }
  }

  test_support::Sandbox sandbox_;
  const std::string own_ = own_library_file("launch-ros-client");
  // The programs of these tests stand in no prefix, so there are no sources beside them.
  const std::string sources_ =
      own_prefix() + "/share/launch/launch_companion, which the package launch-companion brings";
};

TEST_F(RosProgram, IsThatOfTheFirstPrefixWithACompanion) {
  const fs::path first = companion("first", LAUNCH_VERSION "\n");
  const fs::path second = companion("second", LAUNCH_VERSION "\n");
  const Environment environment = {{"AMENT_PREFIX_PATH", "/nowhere::" + first.string() + ":" + second.string()},
                                   {"RMW_IMPLEMENTATION", "rmw_zenoh_cpp"}};
  const std::string expected = (first / "lib/launch_companion/launch-ros-client").string();
  EXPECT_EQ(ros_program("launch-ros-client", environment), expected);
  EXPECT_EQ(companion_program("launch-ros-client", environment), expected);
  EXPECT_TRUE(is_of_companion(expected));
}

TEST_F(RosProgram, IsThatOfThisInstallationForMiddlewaresOfDds) {
  for (const char* const middleware : {"", "rmw_fastrtps_cpp", "rmw_cyclonedds_cpp", "rmw_connextdds"}) {
    EXPECT_EQ(ros_program("launch-ros-client", {{"RMW_IMPLEMENTATION", middleware}}), own_);
  }
  EXPECT_EQ(companion_program("launch-ros-client", {}), std::nullopt);
  EXPECT_FALSE(is_of_companion(own_));
}

TEST_F(RosProgram, IsAnErrorForOtherMiddlewaresWithoutACompanion) {
  EXPECT_EQ(error_of({{"RMW_IMPLEMENTATION", "rmw_zenoh_cpp"}}),
            "error: nodes on rmw_zenoh_cpp need launch_companion, which is in no prefix of AMENT_PREFIX_PATH\n"
            "      = help: build it in your workspace, from " +
                sources_);
}

TEST_F(RosProgram, IsAnErrorForACompanionOfAnotherVersion) {
  const std::string prefix = companion("old", "0.0.9\n").string();
  EXPECT_EQ(error_of({{"AMENT_PREFIX_PATH", prefix}}), "error: launch_companion in " + prefix +
                                                           " is of version 0.0.9, this launch of " LAUNCH_VERSION
                                                           "\n      = help: build it again from " +
                                                           sources_);
  EXPECT_EQ(error_of({{"AMENT_PREFIX_PATH", companion("torn", "").string()}}),
            "error: launch_companion in " + (sandbox_.directory() / "torn").string() +
                " is of version unknown, this launch of " LAUNCH_VERSION "\n      = help: build it again from " +
                sources_);
}

}  // namespace
}  // namespace launch
