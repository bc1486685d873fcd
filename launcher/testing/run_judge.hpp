// SPDX-License-Identifier: Apache-2.0
// Judges the run of a test: passes what happens to its checks, and decides when the run is over.
//
// The run ends at the first of these: a check has failed; everything that is waited for has happened, and the duration
// of the test and its faults are over; its timeout is over; nothing is left to run.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/testing/checks/check.hpp"
#include "launcher/testing/checks/implied_check.hpp"
#include "launcher/testing/checks/trace_check.hpp"
#include "launcher/testing/fault_log.hpp"
#include "launcher/testing/output_tail.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

class RunJudge {
 public:
  // `end` begins the shutdown of the launch. The trace of the run will be in the directory. The loop must outlive the
  // judge.
  RunJudge(EventLoop& loop, std::string trace_directory, std::function<void(const std::string& reason)> end);

  // To be called once, before the processes start.
  void begin(TestRequest test);

  void on_process(const ProcessEvent& event);
  void on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream, std::string_view line);
  void on_fault(const FaultEvent& event);
  void on_shutdown();
  // An error of the launch itself.
  void on_error(const LaunchError& error);

  // After the run.
  void finish();

  const std::vector<Expectation>& expectations() const { return test_.expectations; }
  // Of the processes that have been started.
  std::vector<pid_t> pids() const;
  const std::vector<TestFailure>& failures() const { return failures_; }
  std::size_t met() const;
  std::size_t not_judged() const;
  std::vector<FaultResult> faults() const { return faults_.results(describe_end()); }

 private:
  void decide();
  void judge_trace();
  void end_run(RunEnd end, const std::string& reason);
  void on_timeout();
  std::string describe_end() const;

  EventLoop& loop_;
  std::string trace_directory_;
  std::function<void(const std::string&)> end_launch_;
  TestRequest test_;
  OutputTail tail_;
  ImpliedCheck implied_;
  FaultLog faults_;
  std::vector<std::unique_ptr<Check>> checks_;
  std::vector<Expectation> of_trace_;  // to be judged when the trace is whole
  std::size_t trace_met_ = 0;
  std::vector<RecordedProcess> processes_;
  EventLoop::SourcePtr timeout_;
  EventLoop::SourcePtr duration_;
  bool has_begun_ = false;
  bool duration_over_ = true;
  bool has_ended_ = false;
  bool judges_faults_ = false;  // although the test has timed out
  RunEnd end_ = RunEnd::kNothingLeft;
  std::vector<TestFailure> failures_;
};

}  // namespace launch
