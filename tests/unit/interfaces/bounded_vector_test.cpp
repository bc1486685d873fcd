// SPDX-License-Identifier: Apache-2.0
#include "rosidl_runtime_cpp/bounded_vector.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using Two = rosidl_runtime_cpp::BoundedVector<std::string, 2>;

TEST(BoundedVector, BehavesAsAVectorWithinItsBound) {
  Two words{"a"};
  words.push_back("b");
  EXPECT_EQ(words, (Two{"a", "b"}));
  EXPECT_NE(words, Two{});
  EXPECT_EQ(words.size(), 2u);
  EXPECT_EQ(words.max_size(), 2u);
  EXPECT_EQ(words.data()[1], "b");
  words.erase(words.begin());
  EXPECT_EQ(words.front(), "b");
  words.insert(words.begin(), "first");
  EXPECT_EQ(words.at(0), "first");
  words.assign(1, "only");
  EXPECT_EQ(words.back(), "only");
}

template <typename Action>
void expect_refused(Action action) {
  Two words{"a", "b"};
  try {
    action(words);
    ADD_FAILURE() << "accepted";
  } catch (const std::length_error& error) {
    EXPECT_STREQ(error.what(), "a sequence of this message holds at most 2 elements, not 3");
  }
  EXPECT_EQ(words, (Two{"a", "b"}));
}

TEST(BoundedVector, RefusesToGrowBeyondItsBound) {
  const std::string three[] = {"x", "y", "z"};
  expect_refused([](Two& words) { words.push_back("c"); });
  expect_refused([](Two& words) { words.emplace_back("c"); });
  expect_refused([](Two& words) { words.emplace(words.begin(), "c"); });
  expect_refused([](Two& words) { words.insert(words.end(), "c"); });
  expect_refused([&](Two& words) { words.insert(words.end(), three, three + 1); });
  expect_refused([](Two& words) { words.resize(3); });
  expect_refused([](Two& words) { words.resize(3, "c"); });
  expect_refused([](Two& words) { words.reserve(3); });
  expect_refused([](Two& words) { words.assign(3, "c"); });
  expect_refused([&](Two& words) { words.assign(three, three + 3); });
  expect_refused([](Two& words) { words = {"x", "y", "z"}; });
  expect_refused([](Two&) { Two(3); });
  expect_refused([](Two&) { Two(3, "c"); });
  expect_refused([](Two&) { Two{"x", "y", "z"}; });
  expect_refused([&](Two&) { Two(three, three + 3); });
}

TEST(BoundedVector, HoldsBools) {
  rosidl_runtime_cpp::BoundedVector<bool, 2> flags{true};
  flags.push_back(false);
  EXPECT_TRUE(flags[0]);
  EXPECT_THROW(flags.push_back(true), std::length_error);
}

}  // namespace
