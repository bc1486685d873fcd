// SPDX-License-Identifier: Apache-2.0
// The counts of fired events that processes publish, as the launcher reads them.
#include "tracing/record/account/counters/event_counters.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tracetools/tracetools.h"

namespace {

using test_support::run_command;
using tracing::EventCounts;

#define EVENT_NAME(name, ...) "ros2:" #name,
#define EXT_EVENT_NAME(name, ...) "ros2_ext:" #name,
const std::vector<std::string> kNames = {TRACETOOLS_EVENTS(EVENT_NAME) TRACETOOLS_EXT_EVENTS(EXT_EVENT_NAME)};
#undef EVENT_NAME
#undef EXT_EVENT_NAME

class EventCountersOfProcesses : public testing::Test {
 protected:
  void record(const std::string& events) {
    for (const std::vector<std::string>& argv :
         std::vector<std::vector<std::string>>{{"lttng-sessiond", "--daemonize"},
                                               {"lttng", "create", "counted", "--snapshot"},
                                               {"lttng", "enable-event", "--userspace", events},
                                               {"lttng", "start"}}) {
      const auto result = run_command(argv);
      ASSERT_EQ(result.exit_code, 0) << argv[0] << ' ' << result.err;
    }
  }

  std::vector<EventCounts> run(const std::string& program) {
    std::filesystem::create_directories(directory_);
    EXPECT_EQ(
        run_command({.argv = {program}, .environment = {{"TRACETOOLS_EVENT_COUNTERS", directory_.string()}}}).exit_code,
        0);
    return tracing::EventCounters(directory_).read();
  }

  test_support::Sandbox sandbox_;
  std::filesystem::path directory_ = sandbox_.directory() / "counters";
};

TEST_F(EventCountersOfProcesses, HoldEveryEventThatASessionRecords) {
  record("ros2:*,ros2_ext:*");
  const std::vector<EventCounts> processes = run(FIRE_ALL_EVENTS);
  ASSERT_EQ(processes.size(), 1u);
  EXPECT_EQ(processes[0].process, "fire_all_events");
  EXPECT_GT(processes[0].end, processes[0].begin);
  EXPECT_GT(processes[0].cpu, 0u);
  for (const std::string& name : kNames) {
    EXPECT_TRUE(processes[0].events.contains(name)) << name;
  }
  EXPECT_EQ(processes[0].events.size(), kNames.size());
  EXPECT_EQ(processes[0].total(), kNames.size()) << "once each";
}

TEST_F(EventCountersOfProcesses, LeaveOutWhatNoSessionRecords) {
  record("ros2:rcl_init");
  const std::vector<EventCounts> processes = run(FIRE_ALL_EVENTS);
  ASSERT_EQ(processes.size(), 1u);
  EXPECT_EQ(processes[0].events, (std::map<std::string, std::uint64_t>{{"ros2:rcl_init", 1}}));
}

TEST_F(EventCountersOfProcesses, AreRightForMoreThreadsThanBlocksAndForTheChildOfAFork) {
  record("ros2:*");
  const std::vector<EventCounts> processes = run(COUNT_FROM_THREADS);
  ASSERT_EQ(processes.size(), 2u);
  // In the order of their beginning: the parent comes first. 100 threads at once, then 100 one after the other.
  EXPECT_EQ(processes[0].events.at("ros2:rcl_take"), 200u * 1000u);
  EXPECT_EQ(processes[0].events.at("ros2:rcl_init"), 1u);
  EXPECT_EQ(processes[1].events, (std::map<std::string, std::uint64_t>{{"ros2:rclcpp_take", 7}}));
  EXPECT_NE(processes[0].pid, processes[1].pid);
}

TEST_F(EventCountersOfProcesses, ADirectoryThatIsNotThereDisturbsNobody) {
  EXPECT_EQ(run_command({.argv = {FIRE_ALL_EVENTS}, .environment = {{"TRACETOOLS_EVENT_COUNTERS", "/no/where"}}}).err,
            "");
}

TEST_F(EventCountersOfProcesses, OfProcessesThatHaveEndedArePutAwayAndCountedOnce) {
  record("ros2:*,ros2_ext:*");
  run(FIRE_ALL_EVENTS);
  test_support::RunningCommand living(
      {.argv = {OBJECTS_ON_COMMAND}, .environment = {{"TRACETOOLS_EVENT_COUNTERS", directory_.string()}}});
  living.write("make 1\n");
  ASSERT_TRUE(living.wait_for_output("make 1\n"));
  tracing::EventCounters open(directory_);
  const std::vector<EventCounts> before = open.read();
  ASSERT_EQ(before.size(), 2u);

  tracing::EventCounters::put_ended_processes_away(directory_);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
    files.push_back(entry.path().filename());
  }
  EXPECT_THAT(files,
              testing::UnorderedElementsAre("ended.json", testing::StartsWith(std::to_string(living.pid()) + "-")));
  for (const std::vector<EventCounts>& after : {open.read(), tracing::EventCounters(directory_).read()}) {
    ASSERT_EQ(after.size(), 2u);
    EXPECT_EQ(after[0].process, "fire_all_events");
    EXPECT_EQ(after[0].begin, before[0].begin);
    EXPECT_EQ(after[0].end, before[0].end);
    EXPECT_EQ(after[0].events, before[0].events);
  }

  living.send_signal(SIGKILL);
  living.wait();
  tracing::EventCounters::put_ended_processes_away(directory_);
  const std::vector<EventCounts> after = open.read();
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after[1].events, (std::map<std::string, std::uint64_t>{{"ros2:rcl_timer_init", 1}}));
  EXPECT_EQ(after[1].end, 0u) << "it was killed";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1) << "only ended.json is left";
}

// As of a process in another container, whose number here is another one.
TEST_F(EventCountersOfProcesses, WhoseFileIsLockedAreNotPutAway) {
  run(FIRE_ALL_EVENTS);
  const std::filesystem::path file = std::filesystem::directory_iterator(directory_)->path();
  const int locked = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(locked, LOCK_SH), 0);
  tracing::EventCounters::put_ended_processes_away(directory_);
  EXPECT_TRUE(std::filesystem::exists(file));
  close(locked);
  tracing::EventCounters::put_ended_processes_away(directory_);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(EventCountersOfProcesses, FilesThatAreNoneAreLeftOut) {
  std::filesystem::create_directories(directory_);
  std::ofstream(directory_ / "1-2") << std::string(1000, 'x');
  std::ofstream(directory_ / "3-4");
  EXPECT_TRUE(tracing::EventCounters(directory_).read().empty());
}

}  // namespace
