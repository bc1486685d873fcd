// SPDX-License-Identifier: Apache-2.0
// --shrink: which sets of faults are tried, and what is left.
#include "launcher/testing/shrink.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>

namespace launch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Set = std::set<std::size_t>;

Set numbers(std::size_t count) {
  Set all;
  for (std::size_t number = 1; number <= count; ++number) {
    all.insert(number);
  }
  return all;
}

bool holds(const Set& set, const Set& part) {
  return std::includes(set.begin(), set.end(), part.begin(), part.end());
}

TEST(Shrink, FindsTheOneThatIsToBlame) {
  std::vector<std::string> tried;
  const ShrunkSet found = shrink(numbers(4), [&](const Set& part) {
    tried.push_back(fmt::format("{}", part));
    return holds(part, {3});
  });
  EXPECT_THAT(found.faults, ElementsAre(3));
  EXPECT_EQ(found.runs, 4U);
  EXPECT_THAT(tried, ElementsAre("{}", "{1, 2}", "{3, 4}", "{3}"));
}

TEST(Shrink, ATestThatFailsWithoutFaultsNeedsOneRun) {
  const ShrunkSet found = shrink(numbers(9), [](const Set&) { return true; });
  EXPECT_THAT(found.faults, IsEmpty());
  EXPECT_EQ(found.runs, 1U);
}

TEST(Shrink, KeepsWhatFailsOnlyTogether) {
  for (std::size_t count = 1; count <= 9; ++count) {
    for (std::size_t first = 1; first <= count; ++first) {
      for (std::size_t second = first; second <= count; ++second) {
        const Set needed = {first, second};
        std::size_t runs = 0;
        const ShrunkSet found = shrink(numbers(count), [&](const Set& part) {
          ++runs;
          return holds(part, needed);
        });
        EXPECT_EQ(found.faults, needed);
        EXPECT_EQ(found.runs, runs);
        EXPECT_LE(runs, count * count + 3 * count) << "the bound of the paper";
      }
    }
  }
}

TEST(Shrink, KeepsAllIfNoneCanBeLeftOut) {
  const ShrunkSet found = shrink(numbers(3), [](const Set& part) { return part.size() == 3; });
  EXPECT_EQ(found.faults, numbers(3));
}

TEST(Shrink, RunsNoSetTwice) {
  std::set<Set> tried;
  shrink(numbers(8), [&](const Set& part) {
    EXPECT_TRUE(tried.insert(part).second) << fmt::format("{}", part);
    return holds(part, {2, 7});
  });
}

}  // namespace
}  // namespace launch
