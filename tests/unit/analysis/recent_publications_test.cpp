// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/recent_publications.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

namespace tracing {
namespace {

std::int64_t published_at(RecentPublication* found) {
  return found == nullptr ? -1 : found->publication.published_ns;
}

TEST(RecentPublications, ForgetTheOldest) {
  RecentPublications recent(2);
  std::vector<std::int64_t> forgotten;
  for (const std::int64_t time : {10, 20, 30}) {
    recent.add({time, {.published_ns = time}, false},
               [&](const RecentPublication& oldest) { forgotten.push_back(oldest.source_timestamp); });
  }
  EXPECT_EQ(forgotten, std::vector<std::int64_t>{10});
  EXPECT_EQ(published_at(recent.find(10)), -1);
  EXPECT_EQ(published_at(recent.find(20)), 20);
  EXPECT_EQ(published_at(recent.find(30)), 30);
}

TEST(RecentPublications, ReplaceOneOfTheSameTime) {
  RecentPublications recent(2);
  recent.add({10, {.published_ns = 1}, false}, [](const auto&) { FAIL(); });
  recent.add({20, {.published_ns = 2}, false}, [](const auto&) { FAIL(); });
  recent.add({10, {.published_ns = 3}, false}, [](const auto&) { FAIL(); });
  EXPECT_EQ(published_at(recent.find(10)), 3);
  EXPECT_EQ(recent.all().size(), 2u);
}

// Equal to a plain list, with times that come in their order up to a step, and then in any order and repeat.
class AnyOrder : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(AnyOrder, FindWhatIsThere) {
  constexpr std::size_t kMost = 100;
  RecentPublications recent(kMost);
  std::deque<std::pair<std::int64_t, std::int64_t>> list;  // timestamp, published_ns
  std::mt19937_64 random(1);
  for (std::int64_t step = 0; step < 20'000; ++step) {
    const bool in_order = step < GetParam();
    const auto time = in_order ? step * 7 : static_cast<std::int64_t>(random() % 300) << (step % 40);
    const auto same = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.first == time; });
    bool forgot = false;
    recent.add({time, {.published_ns = step}, false}, [&](const RecentPublication& oldest) {
      forgot = true;
      ASSERT_EQ(oldest.source_timestamp, list.front().first);
    });
    ASSERT_EQ(forgot, same == list.end() && list.size() == kMost);
    if (same != list.end()) {
      same->second = step;
    } else {
      if (forgot) {
        list.pop_front();
      }
      list.emplace_back(time, step);
    }
    const auto asked = in_order ? time - static_cast<std::int64_t>(random() % 800)
                                : static_cast<std::int64_t>(random() % 300) << (random() % 40);
    const auto there = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.first == asked; });
    ASSERT_EQ(published_at(recent.find(asked)), there == list.end() ? -1 : there->second);
  }
}

INSTANTIATE_TEST_SUITE_P(RecentPublications, AnyOrder, ::testing::Values(0, 1, 50, 99, 100, 101, 5'000, 20'000));

}  // namespace
}  // namespace tracing
