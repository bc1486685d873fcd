// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/checks/check.hpp"

#include <fmt/format.h>
#include <string.h>

#include <algorithm>
#include <chrono>

#include "launcher/visit/process_table.hpp"

namespace launch {

namespace {

double seconds_of(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

struct Maker {
  const Expectation& expectation;
  std::unique_ptr<Check> operator()(const ExpectedExit&) const { return make_exit_check(expectation); }
  std::unique_ptr<Check> operator()(const ExpectedOutput&) const { return make_output_check(expectation); }
  std::unique_ptr<Check> operator()(const ExpectedSequence&) const { return make_sequence_check(expectation); }
  std::unique_ptr<Check> operator()(const ExpectedGraph&) const { return make_graph_check(expectation); }
  std::unique_ptr<Check> operator()(const ExpectedMessages&) const { return make_message_check(expectation); }
  std::unique_ptr<Check> operator()(const ExpectedResources&) const { return make_resource_check(expectation); }
  // The trace is judged when it is whole.
  std::unique_ptr<Check> operator()(const TraceExpectation&) const { return nullptr; }
};

}  // namespace

std::string describe(RunEnd end, Duration timeout) {
  switch (end) {
    case RunEnd::kNothingLeft:
      return "before the system ended";
    case RunEnd::kMet:
    case RunEnd::kFailure:
      return "before the test ended";
    case RunEnd::kTimeout:
      return fmt::format("within {:g} s, the timeout of the test", seconds_of(timeout));
  }
  return {};
}

void Check::begin(EventLoop& loop, const OutputTail& tail, std::function<void()> changed) {
  tail_ = &tail;
  changed_ = std::move(changed);
  was_waited_for_ = is_waited_for();
  if (expectation_.within) {
    limit_ = loop.after(*expectation_.within, [this] {
      if (!is_open() || !is_waited_for()) {
        return;
      }
      if (std::optional<Failure> failure = verdict(fmt::format("within {:g} s", seconds_of(*expectation_.within)))) {
        fail(std::move(*failure));
      } else {
        meet();
      }
    });
  }
  on_begin(loop);
}

void Check::finish(RunEnd end, const std::string& when) {
  limit_.reset();
  if (!is_open() || (is_waited_for() && end == RunEnd::kFailure)) {
    return;
  }
  if (std::optional<Failure> failure = verdict(when)) {
    fail(std::move(*failure));
  } else {
    meet();
  }
}

bool Check::concerns(const ProcessSpec& spec, const std::string& label) const {
  const std::string& name = expectation_.process;
  if (name.empty() || name == label) {
    return true;
  }
  const std::vector<std::string> names = names_of(spec);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void Check::meet() {
  if (state_ == State::kOpen) {
    state_ = State::kMet;
    changed_();
  }
}

void Check::fail(Failure failure) {
  if (state_ == State::kOpen) {
    state_ = State::kFailed;
    failure_ = std::move(failure);
    changed_();
  }
}

std::unique_ptr<Check> make_check(const Expectation& expectation) {
  return std::visit(Maker{expectation}, expectation.what);
}

std::string subject_of(const Expectation& expectation) {
  return expectation.process.empty() ? "any process" : fmt::format("'{}'", expectation.process);
}

std::string exit_text(int code) {
  if (code >= 0) {
    return fmt::format("code {}", code);
  }
  const char* const name = ::sigabbrev_np(-code);
  return name == nullptr ? fmt::format("signal {}", -code) : fmt::format("signal SIG{}", name);
}

}  // namespace launch
