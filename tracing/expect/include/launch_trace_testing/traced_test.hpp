// SPDX-License-Identifier: Apache-2.0
// A fixture of GoogleTest whose tests start systems and look at their traces.
//
//   class PingPong : public launch_trace_testing::TracedTest {};
//
//   TEST_F(PingPong, AnswersEachMessage) {
//     start({.file = "ping_pong.launch.xml", .arguments = {{"count", "5"}}});
//     const Trace trace = finish();
//     EXPECT_THAT(trace, Delivers({.topic = "/ping"}, at_least(5)));
//   }
//
// When a test fails, the directory of the run stays, with logs and trace, and its path is printed.
#pragma once

#include <gtest/gtest.h>

#include <iostream>
#include <optional>
#include <utility>

#include "launch_trace_testing/launch_run.hpp"
#include "launch_trace_testing/matchers.hpp"

namespace launch_trace_testing {

class TracedTest : public ::testing::Test {
 protected:
  // Ends the run before, if there is one.
  LaunchRun& start(RunOptions options) {
    end_run();
    return run_.emplace(std::move(options));
  }

  LaunchRun& run() { return run_.value(); }

  // Waits until the system has ended by itself, and reads the trace. Its end must be good: in time, with code 0 (with 3
  // a process has failed or crashed, also during the shutdown), with no process left running, and without a loss of
  // events. Otherwise the test has failed.
  Trace finish() { return checked_trace(run().wait()); }
  // The same, but ends the system as Ctrl-C does.
  Trace stop() { return checked_trace(run().stop()); }

  void TearDown() override { end_run(); }

 private:
  Trace checked_trace(const RunResult& result) {
    EXPECT_FALSE(result.timed_out) << "the system did not end by itself\n" << result.out << result.err;
    EXPECT_TRUE(result.timed_out || result.exit_code == 0) << "the launcher ended with " << result.exit_code << '\n'
                                                           << result.out << result.err;
    EXPECT_THAT(result.left, ::testing::IsEmpty()) << "processes were left running, and have been ended";
    try {
      Trace trace = run().trace();
      EXPECT_THAT(trace, LostNothing());
      return trace;
    } catch (const TraceError& error) {
      ADD_FAILURE() << error.what();
      return {};
    }
  }

  void end_run() {
    if (run_ && HasFailure()) {
      run_->keep();
      std::cout << "the files of the run are in " << run_->directory().string() << '\n';
    }
    run_.reset();
  }

  std::optional<LaunchRun> run_;
};

}  // namespace launch_trace_testing
