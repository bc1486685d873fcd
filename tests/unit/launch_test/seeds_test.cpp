// SPDX-License-Identifier: Apache-2.0
// --seed, --seeds, --faults, and the command that repeats a test.
#include "launcher/testing/seeds.hpp"

#include <gmock/gmock.h>

namespace launch {
namespace {

using testing::ElementsAre;

std::vector<TestCase> two_tests() {
  TestCase first;
  first.file = "my tests/a.launch.xml";
  first.name = "one";
  first.fault_count = 3;
  TestCase second = first;
  second.name = "t*o [x]";
  second.fault_count = 1;
  return {first, second};
}

std::vector<std::string> names(const std::vector<TestCase>& tests) {
  std::vector<std::string> all;
  for (const TestCase& test : tests) {
    all.push_back(test.full_name());
  }
  return all;
}

std::string error_of(const SeedOptions& options) {
  std::vector<TestCase> tests = two_tests();
  try {
    apply_seeds(options, tests);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(Seeds, EachTestRunsWithEachOfThem) {
  std::vector<TestCase> tests = two_tests();
  apply_seeds({.seeds = "2"}, tests);
  EXPECT_THAT(names(tests), ElementsAre("one [seed 1]", "one [seed 2]", "t*o [x] [seed 1]", "t*o [x] [seed 2]"));
  EXPECT_EQ(tests.at(3).seed, 2U);
}

TEST(Seeds, OneSeedLeavesTheNames) {
  std::vector<TestCase> tests = two_tests();
  apply_seeds({.seed = "0"}, tests);
  EXPECT_THAT(names(tests), ElementsAre("one", "t*o [x]"));
  EXPECT_EQ(tests.at(1).seed, 0U);
  EXPECT_TRUE(tests.at(1).shows_seed);
}

TEST(Seeds, TheCommandRepeatsTheTest) {
  std::vector<TestCase> tests = two_tests();
  apply_seeds({.seed = "7", .faults = "1"}, tests);
  EXPECT_EQ(command_of(tests[0], {}), "launch test 'my tests/a.launch.xml' --name one --seed 7 --faults 1");
  EXPECT_EQ(command_of(tests[1], {{"rate", "1 2"}}),
            "launch test 'my tests/a.launch.xml' --name 't\\*o \\[x]' --seed 7 --faults 1 'rate:=1 2'");
  tests[0].is_only = true;
  tests[0].faults = std::set<std::size_t>();
  EXPECT_EQ(command_of(tests[0], {}), "launch test 'my tests/a.launch.xml' --seed 7 --faults none");
}

TEST(Seeds, MistakesAreTold) {
  EXPECT_EQ(error_of({.seed = "x"}), "--seed takes a whole number, got 'x'");
  EXPECT_EQ(error_of({.seeds = "0"}), "--seeds takes a number from 1, got '0'");
  EXPECT_EQ(error_of({.seed = "1", .seeds = "2"}), "--seed and --seeds exclude each other");
  EXPECT_EQ(error_of({.faults = "1,"}), "--faults takes a number from 1, got ''");
  EXPECT_EQ(error_of({.faults = "4"}), "--faults 4: the test 'one' has 3 faults");
  EXPECT_EQ(error_of({.faults = "1,2"}), "--faults 1,2: the test 't*o [x]' has 1 fault");
  EXPECT_EQ(error_of({.faults = "none"}), "");
}

}  // namespace
}  // namespace launch
