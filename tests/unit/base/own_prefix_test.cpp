// SPDX-License-Identifier: Apache-2.0
#include "base/environment/own_prefix.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace launch {
namespace {

TEST(OwnPrefix, IsTheFolderAboveTheOneOfTheProgram) {
  const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe");
  EXPECT_EQ(own_prefix(), program.parent_path().parent_path());
  EXPECT_TRUE(own_prefix().starts_with('/'));
}

TEST(OwnPrefix, HasAFolderForFilesThatNobodyStartsByHand) {
  EXPECT_EQ(own_library_file("launch-guardian"), own_prefix() + "/lib/launch/launch-guardian");
}

TEST(OwnPrefix, NamesThePartThatIsMissing) {
  EXPECT_EQ(needs_missing_file("launch-ros-client"),
            "needs launch-ros-client, which is not in " + own_prefix() +
                "/lib/launch: this installation has been built without the stack");
  EXPECT_EQ(needs_missing_file("launch-test"),
            "needs launch-test, which is not in " + own_prefix() +
                "/lib/launch: this installation has been built without tests in launch files");
  EXPECT_EQ(needs_missing_file("launch-serve"),
            "needs launch-serve, which is not in " + own_prefix() +
                "/lib/launch: this installation has been built without it (libmicrohttpd-dev was missing)");
  EXPECT_EQ(needs_missing_file("launch-twin"),
            "needs launch-twin, which is not in " + own_prefix() + "/lib/launch: the package launch-twin has it");
  EXPECT_EQ(needs_missing_file("launch-report"),
            "needs launch-report, which is not in " + own_prefix() + "/lib/launch");
}

}  // namespace
}  // namespace launch
