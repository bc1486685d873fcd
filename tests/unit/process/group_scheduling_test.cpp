// SPDX-License-Identifier: Apache-2.0
// The scheduling of real threads and processes while they run. None of them becomes more urgent than it was.
#include "launcher/process/group_scheduling.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <thread>

#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/guardian/process_scan.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {
namespace {

int niceness_of(pid_t thread) {
  return ::getpriority(PRIO_PROCESS, static_cast<id_t>(thread));
}

ResourceLimits nice(int niceness) {
  ResourceLimits wanted;
  wanted.niceness = niceness;
  return wanted;
}

// Only with this right threads may become as urgent as they were.
bool may_restore() {
  return ::geteuid() == 0;
}

// A process with a second thread: this one.
class SchedulingOfThreads : public testing::Test {
 protected:
  SchedulingOfThreads() {
    before_.main_thread = ::getpid();
    while (other_ == 0) {
      std::this_thread::yield();
    }
  }
  ~SchedulingOfThreads() override {
    done_ = true;
    done_.notify_one();
  }

  const ProcessesOfGroup own_ = [] { return std::vector<pid_t>{::getpid()}; };
  GroupScheduling before_;
  std::atomic<pid_t> other_ = 0;
  std::atomic<bool> done_ = false;
  std::jthread thread_{[this] {
    other_ = ::gettid();
    done_.wait(false);
  }};
};

TEST_F(SchedulingOfThreads, ChangesForAllOfThemAndIsGivenBack) {
  const int niceness = niceness_of(::getpid());
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 3), before_).has_value());
  EXPECT_EQ(niceness_of(::getpid()), niceness + 3);
  EXPECT_EQ(niceness_of(other_), niceness + 3);
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 5), before_).has_value());
  EXPECT_EQ(niceness_of(other_), niceness + 5);
  const std::optional<SchedulingFailure> failure = restore_scheduling(own_, before_);
  EXPECT_EQ(failure.has_value(), !may_restore());
  EXPECT_EQ(niceness_of(other_), may_restore() ? niceness : niceness + 5);
  EXPECT_EQ(niceness_of(::getpid()), may_restore() ? niceness : niceness + 5);
}

TEST_F(SchedulingOfThreads, AThreadThatStartsLaterGetsBackWhatTheMainThreadHad) {
  if (!may_restore()) {
    GTEST_SKIP() << "skipped, because only root may give back a niceness";
  }
  const int niceness = niceness_of(::getpid());
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 3), before_).has_value());
  std::atomic<pid_t> later = 0;
  std::jthread thread([&](const std::stop_token& stop) {
    later = ::gettid();
    while (!stop.stop_requested()) {
      std::this_thread::yield();
    }
  });
  while (later == 0) {
    std::this_thread::yield();
  }
  EXPECT_EQ(niceness_of(later), niceness + 3);
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 4), before_).has_value());
  EXPECT_EQ(niceness_of(later), niceness + 4);
  EXPECT_FALSE(restore_scheduling(own_, before_).has_value());
  EXPECT_EQ(niceness_of(later), niceness);
}

TEST_F(SchedulingOfThreads, PolicyAndProcessorsAreGivenBack) {
  cpu_set_t cpus;
  ::sched_getaffinity(0, sizeof cpus, &cpus);
  ResourceLimits wanted;
  wanted.policy = SCHED_BATCH;
  wanted.cpus = {allowed_cpus().front()};
  EXPECT_FALSE(change_scheduling(own_, wanted, before_).has_value());
  EXPECT_EQ(::sched_getscheduler(other_), SCHED_BATCH);
  cpu_set_t now;
  ::sched_getaffinity(other_, sizeof now, &now);
  EXPECT_EQ(CPU_COUNT(&now), 1);
  EXPECT_FALSE(restore_scheduling(own_, before_).has_value());
  EXPECT_EQ(::sched_getscheduler(other_), SCHED_OTHER);
  ::sched_getaffinity(other_, sizeof now, &now);
  EXPECT_TRUE(CPU_EQUAL(&now, &cpus));
}

TEST_F(SchedulingOfThreads, WhatTheKernelRefusesChangesNothing) {
  if (!may_restore()) {
    GTEST_SKIP() << "skipped, because only root may give back a niceness";
  }
  const int niceness = niceness_of(::getpid());
  ResourceLimits wanted = nice(niceness + 2);
  wanted.policy = 77;
  const std::optional<SchedulingFailure> failure = change_scheduling(own_, wanted, before_);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->step, kStepPolicy);
  EXPECT_EQ(failure->error, EINVAL);
  EXPECT_EQ(niceness_of(::getpid()), niceness);
  EXPECT_EQ(niceness_of(other_), niceness);
  EXPECT_TRUE(before_.threads.empty());
  EXPECT_EQ(failure_text(*failure, wanted), "cannot set the scheduling policy 77 with priority 0: Invalid argument");
}

// What a thread has set itself, or what was never changed, stays.
TEST_F(SchedulingOfThreads, OnlyWhatWasChangedIsGivenBack) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(allowed_cpus().back()), &one);
  ResourceLimits wanted;
  wanted.policy = SCHED_BATCH;
  EXPECT_FALSE(change_scheduling(own_, wanted, before_).has_value());
  ASSERT_EQ(::sched_setaffinity(other_, sizeof one, &one), 0);
  std::atomic<pid_t> later = 0;
  std::jthread idle([&](const std::stop_token& stop) {
    constexpr sched_param kNone{};
    ::sched_setscheduler(0, SCHED_IDLE, &kNone);
    later = ::gettid();
    while (!stop.stop_requested()) {
      std::this_thread::yield();
    }
  });
  while (later == 0) {
    std::this_thread::yield();
  }
  EXPECT_FALSE(restore_scheduling(own_, before_).has_value());
  EXPECT_EQ(::sched_getscheduler(::getpid()), SCHED_OTHER);
  EXPECT_EQ(::sched_getscheduler(other_), SCHED_OTHER);
  EXPECT_EQ(::sched_getscheduler(later), SCHED_IDLE);
  cpu_set_t now;
  ::sched_getaffinity(other_, sizeof now, &now);
  EXPECT_TRUE(CPU_EQUAL(&now, &one));
}

// A thread that is not changed because it was not there is not in `before` with values that a changed one has given it.
TEST_F(SchedulingOfThreads, ThreadsAreThoseOfTheFirstChange) {
  const int niceness = niceness_of(::getpid());
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 1), before_).has_value());
  std::atomic<bool> done = false;
  std::jthread later([&] { done.wait(false); });
  EXPECT_FALSE(change_scheduling(own_, nice(niceness + 2), before_).has_value());
  EXPECT_EQ(before_.threads.size(), 2u);
  done = true;
  done.notify_one();
}

// Without the capability a niceness can't be lowered again: what is refused is tried before.
TEST_F(SchedulingOfThreads, TheNicenessIsNotChangedIfThePolicyIsRefused) {
  const int niceness = niceness_of(::getpid());
  ResourceLimits wanted = nice(niceness + 2);
  wanted.policy = 77;
  const std::optional<SchedulingFailure> failure = change_scheduling(own_, wanted, before_);
  ASSERT_TRUE(failure.has_value());
  EXPECT_FALSE(failure->leaves_changes);
  EXPECT_EQ(niceness_of(::getpid()), niceness);
}

TEST(SchedulingFailures, SayWhatCannotBeDone) {
  EXPECT_EQ(failure_text({0, ENOTSUP}, {}), "it runs on another machine, where this can't be done yet");
  EXPECT_EQ(failure_text({0, EPERM}, {}),
            "not every thread gets back what it had (that needs the capability CAP_SYS_NICE): Operation not permitted");
  EXPECT_EQ(failure_text({0, EINVAL}, {}), "not every thread gets back what it had: Invalid argument");
  ResourceLimits wanted;
  wanted.policy = 77;
  EXPECT_EQ(failure_text({kStepPolicy, EINVAL, true}, wanted),
            "cannot set the scheduling policy 77 with priority 0: Invalid argument; some threads stay changed, because "
            "giving back what they had needs the capability CAP_SYS_NICE");
}

TEST(SchedulingOfAProcess, HoldsForItsDescendants) {
  const std::unique_ptr<ProcessRunner> runner = make_posix_process_runner(LAUNCH_EXEC);
  ProcessSpec spec;
  spec.name = "a";
  spec.argv = {"sh", "-c", "sleep 1000 & echo started; wait"};
  spec.environment = {{"PATH", "/usr/bin:/bin"}};
  const Process process = runner->spawn(spec);
  pollfd readable{process.out.get(), POLLIN, 0};
  ::poll(&readable, 1, -1);
  const int niceness = niceness_of(process.pid);
  GroupScheduling before;
  EXPECT_FALSE(runner->change_scheduling(process, nice(niceness + 4), before).has_value());
  int found = 0;
  for (const FoundProcess& other : all_processes()) {
    if (other.group == process.pid) {
      ++found;
      EXPECT_EQ(niceness_of(other.pid), niceness + 4);
    }
  }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(runner->restore_scheduling(process, before).has_value(), !may_restore());
  runner->signal_group(process, SIGKILL);
  pollfd exited{process.pidfd.get(), POLLIN, 0};
  ::poll(&exited, 1, -1);
  runner->reap(process);
}

}  // namespace
}  // namespace launch
