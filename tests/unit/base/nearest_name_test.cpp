// SPDX-License-Identifier: Apache-2.0
#include "launcher/base/text/nearest_name.hpp"

#include <gtest/gtest.h>

#include "launcher/base/diagnostics/diagnostic.hpp"

namespace launch {
namespace {

TEST(NearestName, IsOneWithASlipOfTheFingers) {
  const std::vector<std::string> names = {"exec", "exec_name", "env", "pkg"};
  EXPECT_EQ(nearest_name("exce", names), "exec");
  EXPECT_EQ(nearest_name("execname", names), "exec_name");
  EXPECT_EQ(nearest_name("pgk", names), "pkg");
}

TEST(NearestName, IgnoresCase) {
  EXPECT_EQ(nearest_name("PKG", {"pkg"}), "pkg");
}

TEST(NearestName, IsNoneWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("respawn", {"exec", "pkg"}), "");
  EXPECT_EQ(nearest_name("x", {"y", "z"}), "") << "shares no character";
  EXPECT_EQ(nearest_name("exec", {}), "");
}

TEST(NearestName, IsTheFirstOfEquallyNearNames) {
  EXPECT_EQ(nearest_name("cam", {"cat", "can"}), "cat");
}

TEST(DidYouMean, AsksForTheNearestName) {
  EXPECT_EQ(did_you_mean("exce", {"exec", "pkg"}), "did you mean 'exec'?");
  EXPECT_EQ(did_you_mean("respawn", {"exec", "pkg"}), "");
}

}  // namespace
}  // namespace launch
