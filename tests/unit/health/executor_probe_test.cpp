// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/executor_probe.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "launcher/health/progress_memory.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using executor_progress::Doing;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// A directory like /proc, in which one thread has the number of this process.
class ThreadFile {
 public:
  ThreadFile() { std::filesystem::create_directories(task()); }
  ~ThreadFile() { std::filesystem::remove_all(directory_); }

  std::string path() const { return directory_.string(); }
  void set(Duration ran, Duration waited, char state = 'S') const {
    std::ofstream(task() / "schedstat") << ran.count() << ' ' << waited.count() << " 7\n";
    std::ofstream(task() / "stat") << ::getpid() << " (a (b) c) " << state << " 1 1\n";
  }

 private:
  std::filesystem::path task() const {
    return directory_ / std::to_string(::getpid()) / "task" / std::to_string(::getpid());
  }

  std::filesystem::path directory_ =
      std::filesystem::path(testing::TempDir()) / ("health_proc_" + std::to_string(::getpid()));
};

class ExecutorProbeTest : public testing::Test {
 protected:
  ExecutorProbeTest() { probe_.begin(::getpid()); }

  executor_progress::Slot& slot(std::size_t number = 0) {
    executor_progress::Slot& slot = place_.page->slots[number];
    slot.pid = static_cast<std::uint32_t>(::getpid());
    slot.tid = static_cast<std::uint32_t>(::getpid());
    return slot;
  }
  // The thread of the slot does this since now, or waits until then.
  void does(Doing doing, Duration time, std::size_t number = 0) {
    place_.page->joined = 1;
    slot(number).state = executor_progress::pack(doing, static_cast<std::uint64_t>(time.count()));
    ++slot(number).steps;
  }
  Look look_after(Duration passed) {
    now_ += passed;
    return probe_.look(now_, passed);
  }
  // Looks once a second.
  Look look_for(int seconds) {
    Look look;
    for (int i = 0; i < seconds; ++i) {
      look = look_after(1s);
    }
    return look;
  }

  ThreadFile thread_;
  ProgressMemory memory_;
  ProgressMemory::Place place_ = memory_.add();
  ExecutorProbe probe_{*place_.page, 5s, ProcessorWait(thread_.path())};
  Duration now_ = 1000s;
};

TEST_F(ExecutorProbeTest, GoesOnWhileItWaitsForAMessage) {
  place_.page->joined = 1;
  slot().state = executor_progress::pack(Doing::kWaiting, executor_progress::kNever);
  EXPECT_EQ(look_for(100).result, Look::Result::kGood);
}

TEST_F(ExecutorProbeTest, FindsACallbackThatDoesNotEnd) {
  does(Doing::kTimer, now_);
  EXPECT_EQ(look_for(4).result, Look::Result::kGood);
  const Look look = look_for(1);
  EXPECT_EQ(look.result, Look::Result::kBad);
  EXPECT_THAT(look.why, StartsWith("a timer callback has run for 5.0 s, its thread "));
  does(Doing::kWaiting, now_ + 1s);
  EXPECT_EQ(look_for(1).result, Look::Result::kGood) << "it has ended at last";
}

TEST_F(ExecutorProbeTest, DoesNotAddUpCallbacksOfTheSameKind) {
  for (int i = 0; i < 20; ++i) {
    does(Doing::kSubscription, now_);
    EXPECT_EQ(look_for(1).result, Look::Result::kGood);
  }
}

TEST_F(ExecutorProbeTest, FindsOneThreadThatHangsAmongOthers) {
  does(Doing::kTimer, now_);
  does(Doing::kService, now_, 1);
  for (int i = 0; i < 4; ++i) {
    look_for(1);
    does(Doing::kTimer, now_);
  }
  EXPECT_THAT(look_for(1).why, StartsWith("a service callback has run for 5.0 s"));
}

TEST_F(ExecutorProbeTest, FindsAnExecutorThatDoesNotWakeUpForItsTimer) {
  does(Doing::kWaiting, now_ + 10s);
  EXPECT_EQ(look_for(14).result, Look::Result::kGood);
  EXPECT_EQ(look_for(1).why, "an executor has not woken up for a timer that has been due for 5.0 s");
}

TEST_F(ExecutorProbeTest, FindsAnExecutorThatHangsBetweenTwoCallbacks) {
  does(Doing::kBetween, now_);
  EXPECT_THAT(look_for(5).why, StartsWith("an executor has chosen no callback for 5.0 s"));
}

TEST_F(ExecutorProbeTest, FindsALoopThatSpinsNoMore) {
  does(Doing::kAway, now_);
  EXPECT_EQ(look_for(4).result, Look::Result::kGood);
  EXPECT_EQ(look_for(1).why, "no executor has spun for 5.0 s");
}

TEST_F(ExecutorProbeTest, LetsAThreadGoAwayWhileAnotherOneSpins) {
  does(Doing::kAway, now_);
  does(Doing::kWaiting, now_ + 100s, 1);
  EXPECT_EQ(look_for(50).result, Look::Result::kGood);
}

TEST_F(ExecutorProbeTest, DoesNotJudgeAProgramThatHasSpunToItsEnd) {
  does(Doing::kNothing, now_);
  EXPECT_EQ(look_for(50).result, Look::Result::kPending);
}

TEST_F(ExecutorProbeTest, FindsANodeThatNeverBeginsToSpin) {
  place_.page->joined = 1;
  EXPECT_EQ(look_for(4).result, Look::Result::kPending);
  EXPECT_EQ(look_for(1).why, "no executor has begun to spin for 5.0 s");
}

TEST_F(ExecutorProbeTest, SaysOfAForeignProgramThatItCannotBeWatched) {
  const Look look = look_for(5);
  EXPECT_EQ(look.result, Look::Result::kPending);
  EXPECT_THAT(look.note, HasSubstr("it tells nothing of its executors"));
}

TEST_F(ExecutorProbeTest, DoesNotCountTimeThatDoesNotPass) {
  does(Doing::kTimer, now_);
  look_for(4);
  now_ += 3600s;
  EXPECT_EQ(probe_.look(now_, 0s).result, Look::Result::kGood) << "the machine was suspended";
  EXPECT_EQ(look_for(1).result, Look::Result::kBad);
}

TEST_F(ExecutorProbeTest, DoesNotCountTheTimeWithoutAProcessor) {
  thread_.set(0s, 0s);
  does(Doing::kTimer, now_);
  look_for(1);
  for (int i = 1; i < 20; ++i) {
    thread_.set(i * 100ms, i * 900ms, 'R');
    EXPECT_EQ(look_for(1).result, Look::Result::kGood) << i;
  }
  EXPECT_THAT(look_for(1).note, HasSubstr("waits for a processor most of the time"));
}

TEST_F(ExecutorProbeTest, DoesNotBlameAThreadThatGetsNoProcessorAtAll) {
  thread_.set(1s, 1s, 'R');
  does(Doing::kTimer, now_);
  EXPECT_EQ(look_for(100).result, Look::Result::kGood);
  thread_.set(1s, 1s, 'S');
  EXPECT_EQ(look_for(6).result, Look::Result::kBad) << "it sleeps, so it does not want one";
}

TEST_F(ExecutorProbeTest, ForgetsAProcessThatWasKilled) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  does(Doing::kTimer, now_);
  slot().pid = static_cast<std::uint32_t>(child);
  EXPECT_EQ(look_for(9).result, Look::Result::kPending);
  EXPECT_EQ(place_.page->slots[0].pid, 0U);
}

TEST_F(ExecutorProbeTest, BeginsAnewWithEachRun) {
  does(Doing::kTimer, now_);
  EXPECT_EQ(look_for(9).result, Look::Result::kBad);
  probe_.end();
  probe_.begin(::getpid());
  EXPECT_EQ(look_for(1).result, Look::Result::kPending);
}

TEST(ProgressMemory, GivesEachProcessAPageThatItCanOpen) {
  ProgressMemory memory;
  memory.add();
  const ProgressMemory::Place second = memory.add();
  second.page->joined = 7;
  EXPECT_THAT(second.text, StartsWith("4096:/proc/" + std::to_string(::getpid()) + "/fd/"));
  std::ifstream file(second.text.substr(second.text.find(':') + 1));
  file.seekg(4096);
  EXPECT_EQ(file.get(), 7);
}

}  // namespace
}  // namespace launch
