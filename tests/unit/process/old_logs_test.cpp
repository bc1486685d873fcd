// SPDX-License-Identifier: Apache-2.0
// Which log directories of earlier launches are removed.
#include "launcher/process/output/old_logs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include "temporary_directory.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class OldLogs : public testing::Test {
 protected:
  // A run that has ended so many hours ago, with a log of this size.
  fs::path make(const std::string& name, int hours, std::size_t bytes = 10) {
    const fs::path directory = base() / name;
    fs::create_directory(directory);
    mark_log_directory(directory.string());
    write(directory / "launch.log", bytes);
    age(directory, hours);
    return directory;
  }
  static void write(const fs::path& file, std::size_t bytes = 10) { std::ofstream(file) << std::string(bytes, 'x'); }
  static void age(const fs::path& directory, int hours) {
    for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
      fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    }
  }
  std::set<std::string> left() const {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(base())) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  RemovedLogs remove(const std::string& limits) const {
    return remove_old_logs(base().string(), (base() / "own").string(), parse_log_limits(limits));
  }
  fs::path base() const { return base_.path(); }

  TemporaryDirectory base_;
};

TEST_F(OldLogs, AreRemovedByTheirNumberTheOldestFirst) {
  make("a", 4);
  make("b", 3);
  make("c", 2);
  const RemovedLogs removed = remove("3");
  EXPECT_EQ(removed.directories, 1U);
  EXPECT_EQ(removed.left, 3U);
  EXPECT_THAT(left(), ElementsAre("b", "c"));
}

TEST_F(OldLogs, AreRemovedByTheirAge) {
  make("a", 49);
  make("b", 47);
  EXPECT_EQ(remove("2d").directories, 1U);
  EXPECT_THAT(left(), ElementsAre("b"));
}

TEST_F(OldLogs, AreRemovedByTheirSize) {
  make("a", 4, 3000);
  make("b", 3, 3000);
  make("c", 2, 3000);
  EXPECT_GT(remove("7K").bytes, 3000U);
  EXPECT_THAT(left(), ElementsAre("b", "c"));
}

TEST_F(OldLogs, WithoutALimitAllStay) {
  make("a", 100000);
  EXPECT_EQ(remove("all").directories, 0U);
  EXPECT_THAT(left(), ElementsAre("a"));
}

TEST_F(OldLogs, WhatNoLaunchHasMadeStays) {
  fs::create_directory(base() / "2020-01-01-00-00-00-000000-host-1");  // by ros2 launch
  write(base() / "2020-01-01-00-00-00-000000-host-1" / "launch.log");
  write(base() / "talker_1_1.log");
  make("target", 5);
  fs::create_directory_symlink("target", base() / "link");
  remove("1");
  EXPECT_THAT(left(), ElementsAre("2020-01-01-00-00-00-000000-host-1", "link", "talker_1_1.log"));
}

TEST_F(OldLogs, WithAnotherFileInThemTheyStay) {
  write(make("bag", 5) / "data.mcap");
  age(base() / "bag", 5);
  fs::create_directory(make("folder", 5) / "more.log");
  const fs::path rotated = make("rotated", 5);
  write(rotated / "launch.log.1");
  write(rotated / "a-1-stdout.log.12");
  age(rotated, 5);
  remove("1");
  EXPECT_THAT(left(), ElementsAre("bag", "folder"));
}

TEST_F(OldLogs, OfALaunchThatRunsOrHasJustEndedTheyStay) {
  fs::create_directory(base() / "runs");
  const UniqueFd running = mark_log_directory((base() / "runs").string());
  age(base() / "runs", 5);
  make("just", 0);
  make("ended", 5);
  remove("1");
  EXPECT_THAT(left(), ElementsAre("just", "runs"));
}

TEST_F(OldLogs, LimitsThatAreNoneAreRefused) {
  for (const char* const text : {"", "x", "3x", "0", "-1", "5,", "1,,2", "3 d", "99999999999"}) {
    if (std::string(text) == "5,") {
      EXPECT_EQ(parse_log_limits(text).runs, 5U);
      continue;
    }
    EXPECT_THROW(parse_log_limits(text), std::invalid_argument) << text;
  }
  try {
    parse_log_limits("3x");
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "'3x' is no limit for logs, expected such as 200,90d,4G (directories, days, bytes), or all");
  }
}

}  // namespace
}  // namespace launch
