// SPDX-License-Identifier: Apache-2.0
// Pages made by hand, record by record.
#include "tracing/record/kernel/ring_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::kernel::read_ring_page;
using tracing::kernel::RingPage;

class Page {
 public:
  explicit Page(std::uint64_t time) : time_(time) {}

  void word(std::uint32_t value) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&value);
    data_.insert(data_.end(), bytes, bytes + sizeof value);
  }
  void header(std::uint32_t type, std::uint32_t delta) { word(type | delta << 5); }

  std::vector<std::uint8_t> bytes(std::uint64_t flags = 0, std::uint64_t stored = 0) const {
    std::vector<std::uint8_t> page(4096);
    const std::uint64_t commit = data_.size() | flags;
    std::memcpy(page.data(), &time_, sizeof time_);
    std::memcpy(page.data() + 8, &commit, sizeof commit);
    std::memcpy(page.data() + 16, data_.data(), data_.size());
    std::memcpy(page.data() + 16 + data_.size(), &stored, sizeof stored);
    return page;
  }

 private:
  std::uint64_t time_;
  std::vector<std::uint8_t> data_;
};

struct Read {
  RingPage page;
  std::vector<std::uint64_t> times;
  std::vector<std::size_t> lengths;
};

Read read(const std::vector<std::uint8_t>& bytes) {
  Read result;
  result.page = read_ring_page(bytes, [&](std::uint64_t time, std::span<const std::uint8_t> record) {
    result.times.push_back(time);
    result.lengths.push_back(record.size());
  });
  return result;
}

TEST(RingPage, HasRecordsOfBothLengthsAtTheirTimes) {
  Page page(1000);
  page.header(2, 5);  // two words of data
  page.word(1);
  page.word(2);
  page.header(0, 10);  // the length in the first word, itself included
  page.word(12);
  page.word(3);
  page.word(4);
  const Read result = read(page.bytes());
  EXPECT_THAT(result.times, ElementsAre(1005, 1015));
  EXPECT_THAT(result.lengths, ElementsAre(8, 8));
  EXPECT_EQ(result.page.begin, 1005u);
  EXPECT_EQ(result.page.end, 1015u);
  EXPECT_EQ(result.page.lost_records, 0u);
}

TEST(RingPage, TimesAreExtendedAndSet) {
  Page page(1000);
  page.header(30, 1);  // extends by 2 << 27 and 1
  page.word(2);
  page.header(1, 0);
  page.word(0);
  page.header(31, 7);  // sets to 3 << 27 and 7
  page.word(3);
  page.header(1, 1);
  page.word(0);
  EXPECT_THAT(read(page.bytes()).times, ElementsAre(1001 + (std::uint64_t{2} << 27), (std::uint64_t{3} << 27) + 8));
}

TEST(RingPage, DiscardedRecordsAndTheRestArePassedOver) {
  Page page(0);
  page.header(29, 4);  // discarded: its length follows
  page.word(8);
  page.word(0);
  page.header(1, 1);
  page.word(0);
  page.header(29, 0);  // to the end of the page
  page.header(1, 1);
  page.word(0);
  EXPECT_THAT(read(page.bytes()).times, ElementsAre(5));
}

TEST(RingPage, SaysHowManyRecordsWereLostBeforeIt) {
  Page page(0);
  page.header(1, 1);
  page.word(0);
  EXPECT_EQ(read(page.bytes(std::uint64_t{3} << 30, 77)).page.lost_records, 77u);
  EXPECT_EQ(read(page.bytes(std::uint64_t{1} << 31)).page.lost_records, 1u) << "how many is not known";
}

TEST(RingPage, ACutPageEndsWhereItIs) {
  Page page(0);
  page.header(1, 1);
  page.word(0);
  page.header(20, 1);  // eighty bytes that are not there
  EXPECT_THAT(read(page.bytes()).times, ElementsAre(1));
  EXPECT_THAT(read({1, 2, 3}).times, IsEmpty());
}

}  // namespace
