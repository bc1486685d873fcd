// SPDX-License-Identifier: Apache-2.0
// Conditions on what processes use, on virtual time and with processes that use what the test says.
#include "launcher/conditions/process_usage_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using Kind = tracing::LiveCondition::Kind;

constexpr std::uint64_t kMib = 1 << 20;

tracing::LiveCondition condition(Kind kind, double above, Duration window) {
  return {.kind = kind,
          .subject = tracing::LiveCondition::Subject::kProcess,
          .name = "mapper",
          .window = window,
          .above = above};
}

class ProcessUsageWatchTest : public testing::Test {
 protected:
  ProcessUsageWatchTest() {
    watch_.observe([this](const tracing::ConditionReport& report) {
      if (const auto* const changed = std::get_if<tracing::ConditionChanged>(&report)) {
        told_.push_back(fmt::format("{} {} {:.4g} {}", seconds(), changed->change.holds ? "holds" : "is over",
                                    changed->change.figure, fmt::join(changed->change.processes, " ")));
      } else if (const auto* const unseen = std::get_if<tracing::NameNotSeen>(&report)) {
        told_.push_back(fmt::format("{} unseen, there is {}", seconds(), fmt::join(unseen->known, " ")));
      }
    });
  }

  double seconds() const { return std::chrono::duration<double>(loop_.now()).count(); }

  // The process uses this from then on: so much memory, and such a share of a processor.
  void at(Duration time, pid_t pid, std::uint64_t memory, double share = 0) {
    timers_.push_back(loop_.after(time, [this, pid, memory, share] {
      Use& use = uses_[pid];
      use.cpu += use.share * (seconds() - use.since);
      use.since = seconds();
      use.memory = memory;
      use.share = share;
    }));
  }
  void ends_at(Duration time, pid_t pid) {
    timers_.push_back(loop_.after(time, [this, pid] { uses_.erase(pid); }));
  }
  const std::vector<std::string>& run_for(Duration time) {
    timers_.push_back(loop_.after(time, [this] { loop_.quit(); }));
    loop_.run();
    return told_;
  }

  struct Use {
    std::uint64_t memory = 0;
    double share = 0;
    double cpu = 0;
    double since = 0;
  };
  FakeEventLoop loop_;
  std::map<pid_t, Use> uses_;
  std::vector<EventLoop::SourcePtr> timers_;
  std::vector<std::string> told_;
  ProcessUsageWatch watch_{loop_,
                           {.find =
                                [this](const std::string& name) {
                                  std::vector<ProcessUsageWatch::Running> running;
                                  for (const auto& [pid, use] : uses_) {
                                    if (name == "mapper") {
                                      running.push_back({fmt::format("mapper-{}", pid), pid});
                                    }
                                  }
                                  return running;
                                },
                            .names =
                                [] {
                                  return std::vector<std::string>{"mapper", "planner"};
                                },
                            .read =
                                [this](pid_t pid) {
                                  const Use& use = uses_.at(pid);
                                  return ProcessUsage{.cpu = use.cpu + use.share * (seconds() - use.since),
                                                      .memory = use.memory};
                                }}};
};

TEST_F(ProcessUsageWatchTest, MemoryMustBeAboveItsLimitForTheWholeTime) {
  watch_.watch(1, condition(Kind::kMemory, 100 * kMib, 1s));
  at(0s, 1, 50 * kMib);
  at(2s, 1, 120 * kMib);
  at(2500ms, 1, 50 * kMib);
  at(4s, 1, 130 * kMib);
  at(8s, 1, 50 * kMib);
  EXPECT_THAT(run_for(12s), ElementsAre("5 holds 1.363e+08 mapper-1", "8.9 is over 0 mapper-1"));
}

TEST_F(ProcessUsageWatchTest, MemoryGrowsFromTheLeastInTheWindow) {
  watch_.watch(1, condition(Kind::kGrowth, 10 * kMib, 10s));
  at(0s, 1, 100 * kMib);
  for (int step = 1; step <= 20; ++step) {
    at(step * 2s, 1, (100 + static_cast<std::uint64_t>(step)) * kMib);  // 5 MiB in 10 s
  }
  at(45s, 1, 131 * kMib);
  EXPECT_THAT(run_for(70s), ElementsAre("45 holds 1.468e+07 mapper-1", "64 is over 0 mapper-1"));
}

// It loads its map: what it has after its first window is what growth counts from.
TEST_F(ProcessUsageWatchTest, TheStartOfAProcessIsNoGrowth) {
  watch_.watch(1, condition(Kind::kGrowth, 10 * kMib, 10s));
  at(0s, 1, 20 * kMib);
  at(2s, 1, 200 * kMib);
  at(9s, 1, 300 * kMib);
  at(13s, 1, 309 * kMib);
  at(15s, 1, 311 * kMib);
  EXPECT_THAT(run_for(16s), ElementsAre("15 holds 1.153e+07 mapper-1"));
}

TEST_F(ProcessUsageWatchTest, TheShareOfAProcessorIsThatOfTheWindow) {
  watch_.watch(1, condition(Kind::kProcessor, 0.9, 2s));
  at(0s, 1, 0, 0.1);
  at(3s, 1, 0, 1.2);
  at(10s, 1, 0, 0.1);
  EXPECT_THAT(run_for(20s), ElementsAre("4.6 holds 0.98 mapper-1", "12.4 is over 0 mapper-1"));
}

TEST_F(ProcessUsageWatchTest, EachProcessOfTheNameCountsForItself) {
  watch_.watch(1, condition(Kind::kMemory, 100 * kMib, 1s));
  at(0s, 1, 80 * kMib);
  at(0s, 2, 120 * kMib);
  at(2s, 3, 140 * kMib);
  EXPECT_THAT(run_for(5s), ElementsAre("1.1 holds 1.258e+08 mapper-2"));
}

TEST_F(ProcessUsageWatchTest, TheNextProcessOfTheNameBeginsAnew) {
  watch_.watch(1, condition(Kind::kMemory, 100 * kMib, 1s));
  at(0s, 1, 120 * kMib);
  ends_at(3s, 1);
  at(3s, 2, 130 * kMib);
  EXPECT_THAT(run_for(5s),
              ElementsAre("1.1 holds 1.258e+08 mapper-1", "3 is over 0 mapper-2", "4 holds 1.363e+08 mapper-2"));
}

TEST_F(ProcessUsageWatchTest, ANameThatNothingHasIsToldOnce) {
  tracing::LiveCondition wrong = condition(Kind::kMemory, 1, 1s);
  wrong.name = "maper";
  wrong.grace = 2s;
  watch_.watch(1, wrong);
  EXPECT_THAT(run_for(10s), ElementsAre("2 unseen, there is mapper planner"));
}

TEST_F(ProcessUsageWatchTest, WhatIsForgottenIsNotTold) {
  watch_.watch(1, condition(Kind::kMemory, 1, 1s));
  watch_.watch(2, condition(Kind::kMemory, 1, 1s));
  at(0s, 1, 120 * kMib);
  timers_.push_back(loop_.after(500ms, [this] { watch_.forget(1); }));
  timers_.push_back(loop_.after(700ms, [this] { watch_.close(); }));
  EXPECT_THAT(run_for(5s), IsEmpty());
}

}  // namespace
}  // namespace launch
