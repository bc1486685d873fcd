// SPDX-License-Identifier: Apache-2.0
// The shared memory of killed processes goes, and that of living processes stays.
#include "participant/abandoned_memory.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using rmw_fastrtps::remove_abandoned_memory;
using std::chrono::seconds;
using testing::ElementsAre;

std::set<std::string> files_in(const fs::path& directory) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    names.insert(entry.path().filename());
  }
  return names;
}

struct AbandonedMemory : testing::Test {
  void make(const std::string& name) const { test_support::write_file(directory / name, ""); }

  test_support::Sandbox sandbox;
  fs::path directory = sandbox.directory() / "memory";
};

TEST_F(AbandonedMemory, UnlockedSegmentsAndRandomPortsGoWithTheirFiles) {
  fs::create_directory(directory);
  for (const char* name :
       {"fastrtps_0123456789abcdef", "fastrtps_0123456789abcdef_el", "fastrtps_port70000", "fastrtps_port70000_el",
        "sem.fastrtps_port70000_mutex", "fastdds_0123456789abcdef", "fastdds_0123456789abcdef_el", "fastdds_port70000",
        "fastdds_port70000_el", "sem.fastdds_port70000_mutex"}) {
    make(name);
  }
  remove_abandoned_memory(directory, seconds(3600));
  EXPECT_EQ(files_in(directory).size(), 10U) << "they are too young";
  remove_abandoned_memory(directory, seconds(0));
  EXPECT_THAT(files_in(directory), ElementsAre());
}

TEST_F(AbandonedMemory, LockedFilesWellKnownPortsAndFilesOfOthersStay) {
  fs::create_directory(directory);
  const std::set<std::string> names = {"fastrtps_fedcba9876543210",
                                       "fastrtps_fedcba9876543210_el",
                                       "fastrtps_port70001",
                                       "fastrtps_port70001_el",
                                       "sem.fastrtps_port70001_mutex",
                                       "fastrtps_port7412",
                                       "fastrtps_port7412_el",
                                       "fastrtps_port7400_sl",
                                       "fastrtps_short_el",
                                       "mine_0123456789abcdef_el",
                                       "fastrtps_portly_el"};
  for (const std::string& name : names) {
    make(name);
  }
  const int segment = open((directory / "fastrtps_fedcba9876543210_el").c_str(), O_RDONLY | O_CLOEXEC);
  const int port = open((directory / "fastrtps_port70001_el").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(segment, LOCK_EX), 0);
  ASSERT_EQ(flock(port, LOCK_SH), 0);
  remove_abandoned_memory(directory, seconds(0));
  EXPECT_EQ(files_in(directory), names);
  close(segment);
  close(port);
}

TEST_F(AbandonedMemory, WhatAKilledNodeLeavesGoesAndTheNextNodeIsNotTouched) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root /dev/shm is not the test's own";
  }
  const test_support::Command talker{.argv = {TALKER}};
  test_support::RunningCommand killed(talker);
  ASSERT_TRUE(killed.wait_for_output("Publishing"));
  killed.send_signal(SIGKILL);
  killed.wait();
  const std::set<std::string> left = files_in("/dev/shm");
  EXPECT_GE(left.size(), 8U);

  test_support::RunningCommand next(talker);
  ASSERT_TRUE(next.wait_for_output("Publishing"));
  const std::set<std::string> before = files_in("/dev/shm");
  remove_abandoned_memory("/dev/shm", seconds(0));
  const std::set<std::string> after = files_in("/dev/shm");
  for (const std::string& name : before) {
    // The port that all participants share, in place of the multicast port of UDP, is a well-known one.
    std::smatch port;
    const bool is_well_known =
        std::regex_search(name, port, std::regex("_port([0-9]+)")) && (std::stoull(port[1]) & 0x7fffffffU) <= 65535;
    const bool is_of_dds = std::regex_search(name, std::regex("fast(rtps|dds)_"));
    if (!is_of_dds || is_well_known) {
      continue;
    }
    EXPECT_EQ(after.contains(name), !left.contains(name)) << name;
  }
  next.send_signal(SIGINT);
  next.wait();
}

}  // namespace
