// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/names.hpp"

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

TEST(EditDistance, CountsSlipsOfTheFingers) {
  EXPECT_EQ(edit_distance("", "node"), 4u);
  EXPECT_EQ(edit_distance("node", ""), 4u);
  EXPECT_EQ(edit_distance("node", "nodes"), 1u);
  EXPECT_EQ(edit_distance("node", "nide"), 1u);
  EXPECT_EQ(edit_distance("node", "ndoe"), 1u) << "swapped";
  EXPECT_EQ(edit_distance("abcd", "badc"), 2u);
}

TEST(EditDistance, IsExactUpToItsLimit) {
  const std::vector<std::string> words = {"",    "a",     "ab",    "ba",     "abc",    "acb",
                                          "bca", "cabba", "abbca", "abcabc", "cbacba", "ccc"};
  for (const std::string& from : words) {
    for (const std::string& to : words) {
      const std::size_t distance = edit_distance(from, to);
      for (std::size_t limit = 0; limit < 8; ++limit) {
        const std::size_t bounded = edit_distance(from, to, limit);
        const std::string where = from + " to " + to + ", limit " + std::to_string(limit);
        if (distance <= limit) {
          EXPECT_EQ(bounded, distance) << where;
        } else {
          EXPECT_GT(bounded, limit) << where;
        }
      }
    }
  }
}

TEST(DidYouMean, AsksForTheNearestName) {
  EXPECT_EQ(did_you_mean("exce", {"exec", "pkg"}), "did you mean 'exec'?");
  EXPECT_EQ(did_you_mean("respawn", {"exec", "pkg"}), "");
}

}  // namespace
}  // namespace launch
