// SPDX-License-Identifier: Apache-2.0
// <exit process="…" code="…"/>
#include <fmt/format.h>

#include "launcher/testing/checks/check.hpp"

namespace launch {

namespace {

class ExitCheck final : public Check {
 public:
  explicit ExitCheck(const Expectation& expectation)
      : Check(expectation), expected_(std::get<ExpectedExit>(expectation.what)) {}

  bool is_waited_for() const override { return !expected_.after_shutdown; }

  void on_process(const ProcessEvent& event) override {
    if (!concerns(event.spec, event.label)) {
      return;
    }
    if (std::holds_alternative<ProcessStarted>(event.what)) {
      started_ = true;
      labels_ = {event.label};
    } else if (const auto* const failed = std::get_if<ProcessStartFailed>(&event.what)) {
      judge(kExitCodeOfFailedStart, failed->reason);
    } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
      // The end of this process may be what the shutdown begins with.
      const bool by_shutdown = in_shutdown() && exited->expected;
      if (by_shutdown == expected_.after_shutdown) {
        judge(exited->exit.code, {});
      } else {
        other_end_ = fmt::format("it exited with {}, {}", exit_text(exited->exit.code),
                                 by_shutdown ? "but only at the shutdown" : "but before the shutdown");
      }
    }
  }

 protected:
  std::optional<Failure> verdict(const std::string& when) override {
    std::string seen = other_end_;
    if (seen.empty()) {
      seen = started_ ? "it was still running" : "it was never started";
    }
    Failure failure{fmt::format("{} has not exited {}", subject_of(expectation()),
                                expected_.after_shutdown ? "at the shutdown" : when),
                    expectation().where, fmt::format("an exit with code {}", expected_.code.text()), seen};
    tail().show(failure, {labels_.empty() ? expectation().process : labels_.front()});
    return failure;
  }

 private:
  void judge(int code, const std::string& reason) {
    if (expected_.code.matches(code)) {
      meet();
      return;
    }
    Failure failure{fmt::format("{} has exited with {}", subject_of(expectation()), exit_text(code)),
                    expectation().where, fmt::format("an exit with code {}", expected_.code.text()),
                    reason.empty() ? fmt::format("an exit with {}", exit_text(code)) : reason};
    tail().show(failure, {labels_.empty() ? expectation().process : labels_.front()});
    fail(std::move(failure));
  }

  ExpectedExit expected_;
  bool started_ = false;
  std::string other_end_;
};

}  // namespace

std::unique_ptr<Check> make_exit_check(const Expectation& expectation) {
  return std::make_unique<ExitCheck>(expectation);
}

}  // namespace launch
