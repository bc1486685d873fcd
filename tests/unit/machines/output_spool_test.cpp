// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/output_spool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace {

using namespace launch;

class OutputSpoolTest : public testing::Test {
 protected:
  std::string take_all() {
    std::string all_of_it;
    while (!spool.empty()) {
      all_of_it += spool.take(1000, all);
    }
    return all_of_it;
  }

  std::size_t all = 0;
  OutputSpool spool;
};

TEST_F(OutputSpoolTest, GivesWhatItGot) {
  EXPECT_TRUE(spool.is_idle());
  spool.add("one\ntw", all);
  spool.add("o\n", all);
  EXPECT_EQ(all, 8U);
  EXPECT_FALSE(spool.is_idle());
  EXPECT_EQ(spool.take(5, all), "one\nt");
  EXPECT_EQ(take_all(), "wo\n");
  EXPECT_EQ(all, 0U);
  EXPECT_EQ(spool.take_dropped(), 0U);
  EXPECT_TRUE(spool.is_idle());
}

TEST_F(OutputSpoolTest, DropsAndCountsWholeLinesWhenItIsFull) {
  const std::string most(kMostSpooled - 2, 'x');
  spool.add(most + "\n", all);
  spool.add("two\n", all);
  spool.add("\n", all);  // it would fit, but what comes behind a gap is dropped, too
  spool.add("three\nfo", all);
  EXPECT_EQ(spool.take_dropped(), 4U);
  EXPECT_EQ(take_all(), most + "\n");
  spool.add("ur\nfive\n", all);
  EXPECT_EQ(take_all(), "five\n");
  EXPECT_EQ(spool.take_dropped(), 0U);
}

TEST_F(OutputSpoolTest, ALineOfWhichTheBeginningIsThereEndsThere) {
  const std::string most(kMostSpooled, 'x');
  spool.pass("begin ");
  spool.add(most + "rest\nnext\n", all);
  EXPECT_EQ(spool.take_dropped(), 2U);
  EXPECT_EQ(take_all(), "\n");
  spool.add("last\n", all);
  EXPECT_EQ(take_all(), "last\n");
}

TEST_F(OutputSpoolTest, ALineOfWhichOnlyTheBeginningFitsIsDropped) {
  const std::string most(kMostSpooled - 5, 'x');
  spool.add(most + "\ntwo", all);
  spool.add(" rest\n", all);
  EXPECT_EQ(spool.take_dropped(), 1U);
  EXPECT_EQ(take_all(), most + "\n");
  EXPECT_EQ(all, 0U);
}

TEST_F(OutputSpoolTest, AllSpoolsTogetherHaveALimit) {
  all = kMostSpooledOfAll - 4;
  spool.add("one\ntwo\n", all);
  EXPECT_EQ(all, kMostSpooledOfAll);
  EXPECT_EQ(take_all(), "one\n");
  EXPECT_EQ(spool.take_dropped(), 1U);
}

TEST_F(OutputSpoolTest, WhateverThePiecesAreEachLineComesWholeOrCounts) {
  std::mt19937 random(3);
  for (int round = 0; round < 30; ++round) {
    spool = {};
    all = 0;
    std::uint64_t lines = 0;
    std::string text;
    while (text.size() < kMostSpooled + kMostSpooled / 3) {
      text += "line " + std::to_string(lines++) + std::string(random() % 3000, '.') + "\n";
    }
    const std::size_t returns = kMostSpooled + random() % (kMostSpooled / 4);
    std::string got;
    std::uint64_t dropped = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t size = 1 + random() % 70'000;
      spool.add(std::string_view(text).substr(begin, size), all);
      if (begin < returns && begin + size >= returns) {
        dropped += spool.take_dropped();
        got += take_all();
      }
      begin += size;
    }
    dropped += spool.take_dropped();
    got += take_all();
    const auto came = static_cast<std::uint64_t>(std::count(got.begin(), got.end(), '\n'));
    EXPECT_EQ(came + dropped, lines);
    for (std::size_t begin = 0; begin < got.size();) {
      const std::size_t end = got.find('\n', begin) + 1;
      ASSERT_NE(text.find(got.substr(begin, end - begin)), std::string::npos);
      begin = end;
    }
  }
}

}  // namespace
