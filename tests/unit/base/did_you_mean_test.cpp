// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "launcher/base/diagnostic.hpp"

namespace launch {
namespace {

TEST(DidYouMean, SuggestsTheNearestName) {
  const std::vector<std::string> names = {"exec", "exec_name", "env", "pkg"};
  EXPECT_EQ(did_you_mean("exce", names), "did you mean 'exec'?");
  EXPECT_EQ(did_you_mean("execname", names), "did you mean 'exec_name'?");
  EXPECT_EQ(did_you_mean("pgk", names), "did you mean 'pkg'?");
}

TEST(DidYouMean, IgnoresCase) {
  EXPECT_EQ(did_you_mean("PKG", {"pkg"}), "did you mean 'pkg'?");
}

TEST(DidYouMean, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("respawn", {"exec", "pkg"}), "");
  EXPECT_EQ(did_you_mean("x", {"y", "z"}), "") << "shares no character";
  EXPECT_EQ(did_you_mean("exec", {}), "");
}

TEST(DidYouMean, PrefersTheFirstOfEquallyNearNames) {
  EXPECT_EQ(did_you_mean("cam", {"cat", "can"}), "did you mean 'cat'?");
}

}  // namespace
}  // namespace launch
