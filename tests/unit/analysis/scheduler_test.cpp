// SPDX-License-Identifier: Apache-2.0
// Where the time of callbacks goes, according to the kernel's scheduler.
#include <gtest/gtest.h>

#include "tests/support/trace_writer/scheduler_writer.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr std::int64_t kTraceBegin = 1'767'225'600'000'000'000;
constexpr Thread kSleeper{71, 74, "node"};
constexpr Thread kStress{90, 90, "stress"};
constexpr Thread kIdle{0, 0, "swapper/0"};

class Scheduler : public ::testing::Test {
 protected:
  void goes_to_processor(unsigned cpu, std::int64_t time, const Thread& thread) {
    scheduler_.switches(cpu, kTraceBegin + time, kIdle, 0, thread);
  }
  // `state`: 0 when the previous thread could go on.
  void switches(std::int64_t time, const Thread& previous, std::int64_t state, const Thread& next) {
    scheduler_.switches(0, kTraceBegin + time, previous, state, next);
  }
  void wakes(std::int64_t time, const Thread& waker, const Thread& woken) {
    scheduler_.wakes(0, kTraceBegin + time, waker, woken);
  }
  template <class Struct>
  void writes(std::int64_t time, const Struct& event) {
    writer_.write(0, kTraceBegin + time, kSleeper, event);
  }
  CallbackResult result() {
    writer_.finish();
    TraceAnalysis analysis(&sink_);
    TraceReader(directory_.path()).read(analysis);
    return analysis.finish().ros2.callbacks.at(0);
  }

  struct Intervals : ExecutionSink {
    void on_thread_state(const ThreadInterval& interval) override {
      if (interval.thread.vtid == kSleeper.vtid) {
        states.push_back(interval.state);
        others.emplace_back(interval.other_name);
      }
    }
    std::vector<ThreadInterval::State> states;
    std::vector<std::string> others;
  };
  Intervals sink_;

 private:
  TemporaryDirectory directory_;
  TraceWriter writer_{directory_.path()};
  testing::SchedulerWriter scheduler_{writer_};
};

TEST_F(Scheduler, NamesWhoHasNotBeenSwitchedOffYet) {
  switches(100, kSleeper, 0, kStress);
  goes_to_processor(1, 5'100, kSleeper);
  writes(6'000, ros2::CallbackStart{0xcb, false});
  writes(7'000, ros2::CallbackEnd{0xcb});
  result();
  ASSERT_FALSE(sink_.others.empty());
  EXPECT_EQ(sink_.others[0], "stress");
}

TEST_F(Scheduler, DividesTheTimeOfACallback) {
  switches(100, kSleeper, 1, kIdle);
  wakes(200, kIdle, kSleeper);
  switches(210, kIdle, 0, kSleeper);
  writes(1'000, ros2::CallbackStart{0xcb, false});
  switches(1'100, kSleeper, 0, kStress);  // preempted
  switches(9'100, kStress, 0, kSleeper);
  switches(9'200, kSleeper, 1, kStress);  // sleeps
  wakes(9'500, kStress, kSleeper);
  switches(9'520, kStress, 1, kSleeper);
  writes(10'000, ros2::CallbackEnd{0xcb});
  const CallbackResult callback = result();
  EXPECT_EQ(callback.durations.max_ns, 9'000);
  EXPECT_EQ(callback.running.count, 1u);
  EXPECT_EQ(callback.running.max_ns, 100 + 100 + 480);
  EXPECT_EQ(callback.runnable.max_ns, 8'000 + 20);
  EXPECT_EQ(callback.blocked.max_ns, 300);
  EXPECT_EQ(callback.longest_runnable_ns, 8'000);
  EXPECT_EQ(callback.ran_instead, "stress");
  EXPECT_EQ(callback.ran_instead_ns, 8'000);
  using State = ThreadInterval::State;
  EXPECT_EQ(sink_.states, (std::vector{State::kBlocked, State::kRunnable, State::kRunning, State::kRunnable,
                                       State::kRunning, State::kBlocked, State::kRunnable}));
}

// The last one before the thread came back had the processor for a moment only.
TEST_F(Scheduler, NamesTheThreadThatHadTheProcessorLongest) {
  constexpr Thread kMunged{91, 91, "munged"};
  switches(100, kSleeper, 1, kIdle);
  switches(210, kIdle, 0, kSleeper);
  writes(1'000, ros2::CallbackStart{0xcb, false});
  switches(1'100, kSleeper, 0, kStress);
  switches(5'100, kStress, 0, kMunged);
  switches(5'200, kMunged, 1, kStress);
  switches(9'100, kStress, 0, kMunged);
  switches(9'200, kMunged, 1, kSleeper);
  writes(10'000, ros2::CallbackEnd{0xcb});
  const CallbackResult callback = result();
  EXPECT_EQ(callback.longest_runnable_ns, 8'100);
  EXPECT_EQ(callback.ran_instead, "stress");
  EXPECT_EQ(callback.ran_instead_ns, 7'900);
}

TEST_F(Scheduler, SaysNothingOfAThreadThatTheKernelDidNotTellOf) {
  writes(1'000, ros2::CallbackStart{0xcb, false});
  switches(1'100, kStress, 0, kIdle);
  writes(2'000, ros2::CallbackEnd{0xcb});
  EXPECT_EQ(result().running.count, 0u);
}

}  // namespace
}  // namespace tracing
