// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/handle_index.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace tracing {
namespace {

TEST(HandleIndex, KeepsEqualHandlesOfTwoProcessesApart) {
  HandleIndex<int> index;
  EXPECT_EQ(index.find({1, 0x100}), nullptr);
  index[{1, 0x100}] = 1;
  index[{2, 0x100}] = 2;
  EXPECT_EQ(*index.find({1, 0x100}), 1);
  EXPECT_EQ(*index.find({2, 0x100}), 2);
  index.erase({1, 0x100});
  EXPECT_EQ(index.find({1, 0x100}), nullptr);
  EXPECT_EQ(*index.find({2, 0x100}), 2);
  EXPECT_EQ((index[{1, 0x100}]), 0) << "a new one";
}

TEST(HandleIndex, FindsWhatAMapFinds) {
  std::mt19937 random(1);
  HandleIndex<std::uint64_t> index;
  std::map<std::pair<ProcessId, ros2::Handle>, std::uint64_t> expected;
  for (std::uint64_t step = 0; step < 100'000; ++step) {
    const ProcessId process = random() % 4;
    const ros2::Handle handle = 0x55550000 + 16 * (random() % 200);
    const bool is_erased = random() % 3 == 0;
    if (is_erased) {
      index.erase({process, handle});
      expected.erase({process, handle});
    } else {
      index[{process, handle}] = step;
      expected[{process, handle}] = step;
    }
    const ros2::Handle other = 0x55550000 + 16 * (random() % 200);
    const std::uint64_t* const found = index.find({process, other});
    const auto known = expected.find({process, other});
    ASSERT_EQ(found == nullptr, known == expected.end()) << step;
    if (found != nullptr) {
      ASSERT_EQ(*found, known->second) << step;
    }
  }
}

}  // namespace
}  // namespace tracing
