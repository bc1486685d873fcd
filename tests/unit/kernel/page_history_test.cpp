// SPDX-License-Identifier: Apache-2.0
// The pages from which a snapshot is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tracing/record/kernel/ring_page.hpp"
#include "tracing/record/kernel/snapshot_writer.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::kernel::forget_lost_records;
using tracing::kernel::PageHistory;
using tracing::kernel::read_ring_page;

constexpr std::size_t kSize = 4096;
constexpr std::uint64_t kMissed = std::uint64_t{1} << 31;

PageHistory::Page page(std::uint64_t time, std::uint64_t flags = 0) {
  PageHistory::Page bytes(kSize);
  std::memcpy(bytes.data(), &time, sizeof time);
  std::memcpy(bytes.data() + 8, &flags, sizeof flags);
  return bytes;
}

std::vector<std::uint64_t> times(PageHistory& history, unsigned cpu) {
  std::vector<std::uint64_t> result;
  for (const PageHistory::KeptPage& kept : history.processors().at(cpu).pages) {
    result.push_back(read_ring_page(kept.bytes, [](auto, auto) {}).begin);
  }
  return result;
}

std::vector<std::uint64_t> numbers(PageHistory& history, unsigned cpu) {
  std::vector<std::uint64_t> result;
  for (const PageHistory::KeptPage& kept : history.processors().at(cpu).pages) {
    result.push_back(kept.number);
  }
  return result;
}

TEST(PageHistory, KeepsTheNewestPagesOfEachProcessor) {
  PageHistory history(3 * kSize);
  for (std::uint64_t time = 1; time <= 5; ++time) {
    history.add(0, page(time));
  }
  history.add(1, page(9));
  EXPECT_THAT(times(history, 0), ElementsAre(3, 4, 5));
  EXPECT_THAT(times(history, 1), ElementsAre(9));
}

TEST(PageHistory, KeepsAPageThatIsLargerThanItsLimit) {
  PageHistory history(1);
  history.add(0, page(1));
  history.add(0, page(2));
  EXPECT_THAT(times(history, 0), ElementsAre(2));
}

TEST(PageHistory, BeginsAgainAfterOverwrittenRecords) {
  PageHistory history(10 * kSize);
  EXPECT_FALSE(history.add(0, page(1)));
  EXPECT_FALSE(history.add(1, page(1)));
  EXPECT_TRUE(history.add(0, page(2, kMissed)));
  EXPECT_FALSE(history.add(0, page(3)));
  EXPECT_THAT(times(history, 0), ElementsAre(2, 3));
  EXPECT_THAT(numbers(history, 0), ElementsAre(2, 3)) << "1 is left out for what was overwritten";
  EXPECT_THAT(times(history, 1), ElementsAre(1));
  EXPECT_EQ(read_ring_page(history.processors().at(0).pages.front().bytes, [](auto, auto) {}).lost_records, 0u);
}

TEST(PageHistory, IsEmptyWhenItWasCleared) {
  PageHistory history(kSize);
  history.add(0, page(1));
  history.clear();
  EXPECT_THAT(times(history, 0), IsEmpty());
  history.add(0, page(2));
  EXPECT_THAT(numbers(history, 0), ElementsAre(1)) << "no number is given twice";
}

TEST(RingPage, ForgetsLostRecordsOnce) {
  PageHistory::Page bytes = page(1, kMissed);
  EXPECT_EQ(read_ring_page(bytes, [](auto, auto) {}).lost_records, 1u);
  EXPECT_TRUE(forget_lost_records(bytes));
  EXPECT_FALSE(forget_lost_records(bytes));
  PageHistory::Page cut(4);
  EXPECT_FALSE(forget_lost_records(cut));
}

}  // namespace
