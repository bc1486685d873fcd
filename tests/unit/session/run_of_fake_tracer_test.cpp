// SPDX-License-Identifier: Apache-2.0
// TracedRun: what it tells, and what it leaves when something fails. The session itself is a fake.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/fake/fake_tracer.hpp"
#include "tracing/record/session/traced_run.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tracing::FakeTracer;
using tracing::TracedRun;
using tracing::TraceError;

class TracedRunOfAFakeTracer : public testing::Test {
 protected:
  TracedRunOfAFakeTracer() {
    config_.session_name = "a";
    config_.base_path = "/nonexistent/traces";
    fake_ = std::make_unique<FakeTracer>();
  }

  // The tracer belongs to the run from now on.
  TracedRun& run() {
    if (!run_) {
      tracer_ = fake_.get();
      run_ = std::make_unique<TracedRun>(config_, std::move(fake_), "/nonexistent", choices_);
    }
    return *run_;
  }
  // What a step says when it fails.
  std::string error_of(const std::function<void()>& step) {
    try {
      step();
    } catch (const TraceError& error) {
      return error.what();
    }
    return "none";
  }
  void start() { run().start(tell(), {}); }
  void finish() { run().finish(tell()); }
  TracedRun::Tell tell() {
    return [this](bool warning, const std::string& text) { told_.push_back((warning ? "warning: " : "") + text); };
  }

  tracing::TraceConfig config_;
  tracing::RunChoices choices_;
  std::unique_ptr<FakeTracer> fake_;
  FakeTracer* tracer_ = nullptr;
  std::unique_ptr<TracedRun> run_;
  std::vector<std::string> told_;
};

TEST_F(TracedRunOfAFakeTracer, TellsWarningsThenNotesThenTheDirectory) {
  fake_->setup_report.warnings = {"of the tracer"};
  fake_->setup_report.notes = "a note";
  run().warn("of the launcher");
  start();
  EXPECT_THAT(told_, ElementsAre("warning: of the launcher", "warning: of the tracer", "a note",
                                 "writing tracing session to: /nonexistent/traces/a"));
}

TEST_F(TracedRunOfAFakeTracer, AFailedStartTellsNothingAndLeavesNoSession) {
  fake_->start_error = TraceError("no daemon");
  run();
  EXPECT_EQ(error_of([this] { start(); }), "no daemon");
  EXPECT_THAT(told_, IsEmpty());
  EXPECT_THAT(tracer_->open_sessions(), IsEmpty());
}

TEST_F(TracedRunOfAFakeTracer, ASessionWhoseGuardCannotWorkIsEnded) {
  config_.max_overhead = 0.02;  // needs a directory of counters, which only clean_up_command() makes
  EXPECT_EQ(error_of([this] { start(); }), "max-overhead needs shared memory to count events in");
  EXPECT_THAT(tracer_->calls(), ElementsAre("start a", "finish a"));
  EXPECT_THAT(tracer_->open_sessions(), IsEmpty());
}

TEST_F(TracedRunOfAFakeTracer, FailsForLossesAfterItHasToldThem) {
  config_.fail_on_loss = true;
  fake_->losses.channels = {{}};
  fake_->losses.channels[0].discarded_events = 3;
  start();
  told_.clear();
  EXPECT_EQ(error_of([this] { finish(); }), "the trace of session 'a' is incomplete");
  ASSERT_GE(told_.size(), 2U);
  EXPECT_EQ(told_[0], "trace written to: /nonexistent/traces/a");
  EXPECT_THAT(told_[1], HasSubstr("warning: trace is incomplete: "));
}

TEST_F(TracedRunOfAFakeTracer, ATraceThatIsNotThereIsNotNamed) {
  fake_->losses.wrote_nothing = true;
  start();
  told_.clear();
  finish();
  EXPECT_THAT(told_, ElementsAre("warning: no trace was written: nothing was recorded"));
}

TEST_F(TracedRunOfAFakeTracer, ASessionWithoutASnapshotNamesNoTrace) {
  config_.dual_session = true;
  start();
  told_.clear();
  finish();
  EXPECT_THAT(told_, ElementsAre("no trace was written: no snapshot was taken"));
}

TEST_F(TracedRunOfAFakeTracer, NamesTheSessionThatCannotBeFinished) {
  fake_->finish_error = TraceError("it is gone");
  start();
  EXPECT_EQ(error_of([this] { finish(); }), "tracing session 'a' could not be finished: it is gone");
}

TEST_F(TracedRunOfAFakeTracer, AHurryEndsAFinishThatWaits) {
  fake_->block_finish();
  start();
  run().hurry();
  finish();
  EXPECT_THAT(tracer_->calls(), ElementsAre("start a", "finish a", "give up a"));
}

TEST_F(TracedRunOfAFakeTracer, ASnapshotWithoutARecorderIsNotTaken) {
  run().request_snapshot("too early");
  start();
  run().request_snapshot("no flight recorder");
  finish();
  EXPECT_THAT(tracer_->calls(), ElementsAre("start a", "finish a"));
}

TEST_F(TracedRunOfAFakeTracer, DeadlinesAddTheEventsThatTellOfThem) {
  choices_.callback_deadline = 5;
  choices_.message_deadline = 7;
  EXPECT_THAT(run().config().further_events_ust, ElementsAre("ros2_deadline:callback", "ros2_deadline:message"));
}

}  // namespace
