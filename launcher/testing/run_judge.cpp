// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/run_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "launcher/visit/process_table.hpp"

namespace launch {

RunJudge::RunJudge(EventLoop& loop, std::string trace_directory, std::function<void(const std::string&)> end)
    : loop_(loop),
      trace_directory_(std::move(trace_directory)),
      end_launch_(std::move(end)),
      implied_(tail_, [this](Failure failure) {
        if (end_ == RunEnd::kNothingLeft || end_ == RunEnd::kMet) {
          failures_.push_back(as_text(failure));
          end_run(RunEnd::kFailure, "a process has failed");
        }
      }) {}

void RunJudge::begin(TestRequest test) {
  has_begun_ = true;
  test_ = std::move(test);
  faults_.begin(std::move(test_.faults), loop_.now());
  timeout_ = loop_.after(test_.timeout, [this] { on_timeout(); });
  if (test_.duration) {
    duration_over_ = false;
    duration_ = loop_.after(*test_.duration, [this] {
      duration_over_ = true;
      decide();
    });
  }
  for (const Expectation& expectation : test_.expectations) {
    if (std::holds_alternative<ExpectedExit>(expectation.what)) {
      implied_.leave_out(expectation.process);
    }
    if (std::unique_ptr<Check> check = make_check(expectation)) {
      checks_.push_back(std::move(check));
    } else {
      of_trace_.push_back(expectation);
    }
  }
  for (const std::unique_ptr<Check>& check : checks_) {
    check->begin(loop_, tail_, [this] { decide(); });
  }
}

void RunJudge::on_process(const ProcessEvent& event) {
  if (const auto* const started = std::get_if<ProcessStarted>(&event.what)) {
    std::vector<std::string> names = names_of(event.spec);
    names.push_back(event.label);
    processes_.push_back({std::move(names), started->pid});
  }
  for (const std::unique_ptr<Check>& check : checks_) {
    check->on_process(event);
  }
  implied_.on_process(event);
}

void RunJudge::on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream, std::string_view line) {
  tail_.add(label, line);
  for (const std::unique_ptr<Check>& check : checks_) {
    check->on_line(spec, label, stream, line);
  }
}

void RunJudge::on_fault(const FaultEvent& event) {
  faults_.on_fault(event, loop_.now());
  if (event.signal != 0) {
    for (const std::string& label : event.labels) {
      implied_.expect_end(label, event.signal);
    }
  }
  decide();
}

void RunJudge::on_shutdown() {
  for (const std::unique_ptr<Check>& check : checks_) {
    check->on_shutdown();
  }
}

void RunJudge::on_error(const LaunchError& error) {
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    failures_.push_back(as_text(diagnostic));
  }
  end_run(RunEnd::kFailure, "an error");
}

void RunJudge::decide() {
  const auto failed = [](const auto& check) { return check->failure() != nullptr; };
  if (std::any_of(checks_.begin(), checks_.end(), failed)) {
    end_run(RunEnd::kFailure, "an expectation has failed");
    return;
  }
  if (!duration_over_ || faults_.is_open()) {
    return;
  }
  // Without anything to wait for, and without a duration, the system decides when it ends.
  bool waited = test_.duration.has_value();
  for (const std::unique_ptr<Check>& check : checks_) {
    if (check->is_waited_for() && check->is_open()) {
      return;
    }
    waited = waited || check->was_waited_for();
  }
  if (waited) {
    end_run(RunEnd::kMet, "everything that the test waits for has happened");
  }
}

void RunJudge::end_run(RunEnd end, const std::string& reason) {
  if (has_ended_) {
    return;
  }
  has_ended_ = true;
  end_ = end;
  timeout_.reset();
  duration_.reset();
  end_launch_(reason);
}

void RunJudge::on_timeout() {
  const auto is_waited_for = [](const auto& check) { return check->is_open() && check->is_waited_for(); };
  if (std::none_of(checks_.begin(), checks_.end(), is_waited_for) && faults_.is_open() &&
      faults_.is_open_for_messages_only()) {
    // What they have hit is known when the run has ended.
    judges_faults_ = true;
  } else if (std::none_of(checks_.begin(), checks_.end(), is_waited_for) && faults_.is_open()) {
    failures_.push_back(as_text(Failure{fmt::format("the {} was not over {}", launch::describe(faults_.open()),
                                                    launch::describe(RunEnd::kTimeout, test_.timeout)),
                                        faults_.open().where}));
  } else if (std::none_of(checks_.begin(), checks_.end(), is_waited_for)) {
    Failure failure{fmt::format("the system has not ended within {:g} s, the timeout of the test",
                                std::chrono::duration<double>(test_.timeout).count()),
                    test_.where};
    failure.help = "duration=\"…\" ends it after a while";
    tail_.show(failure);
    failures_.push_back(as_text(failure));
  }
  end_run(RunEnd::kTimeout, "the test has timed out");
  for (const std::unique_ptr<Check>& check : checks_) {
    if (is_waited_for(check)) {
      check->finish(end_, describe(end_, test_.timeout));
    }
  }
}

void RunJudge::finish() {
  timeout_.reset();
  duration_.reset();
  has_ended_ = true;
  const std::string when = describe(end_, test_.timeout);
  for (const std::unique_ptr<Check>& check : checks_) {
    check->finish(end_, when);
  }
  std::vector<TestFailure> found;
  for (const std::unique_ptr<Check>& check : checks_) {
    if (check->failure() != nullptr) {
      found.push_back(as_text(*check->failure()));
    }
  }
  failures_.insert(failures_.begin(), found.begin(), found.end());
  if (judges_faults_ || (end_ != RunEnd::kFailure && end_ != RunEnd::kTimeout)) {
    for (const Failure& failure : faults_.failures(describe_end())) {
      failures_.push_back(as_text(failure));
    }
  }
  judge_trace();
  if (!has_begun_ && failures_.empty()) {
    failures_.push_back({.message = "the test has not begun", .text = "error: the test has not begun\n"});
  }
}

std::string RunJudge::describe_end() const {
  return end_ == RunEnd::kNothingLeft ? "the system had ended" : "the test had ended";
}

void RunJudge::judge_trace() {
  if (of_trace_.empty() || !has_begun_ || end_ == RunEnd::kFailure) {
    return;
  }
  const std::vector<Failure> found = launch::judge_trace(of_trace_, trace_directory_, processes_, test_.where);
  for (const Failure& failure : found) {
    failures_.push_back(as_text(failure));
  }
  trace_met_ = of_trace_.size() - std::min(of_trace_.size(), found.size());
  of_trace_.clear();
}

std::vector<pid_t> RunJudge::pids() const {
  std::vector<pid_t> pids;
  for (const RecordedProcess& process : processes_) {
    pids.push_back(process.pid);
  }
  return pids;
}

std::size_t RunJudge::met() const {
  return trace_met_ + static_cast<std::size_t>(std::count_if(checks_.begin(), checks_.end(),
                                                             [](const auto& check) { return check->is_met(); }));
}

std::size_t RunJudge::not_judged() const {
  return of_trace_.size() + static_cast<std::size_t>(std::count_if(checks_.begin(), checks_.end(),
                                                                   [](const auto& check) { return check->is_open(); }));
}

}  // namespace launch
