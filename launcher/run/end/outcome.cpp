// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/outcome.hpp"

#include <variant>

namespace launch {

namespace {

constexpr int kExitCodeOfSignal = 128;  // plus its number, as shells count
constexpr int kExitCodeOfFailures = 3;

}  // namespace

bool ends_launch(const ProcessEvent& event) {
  const auto* const exited = std::get_if<ProcessExited>(&event.what);
  const bool restarts = exited != nullptr && exited->expected && exited->will_respawn;
  const bool has_ended = exited != nullptr ? !restarts : std::holds_alternative<ProcessStartFailed>(event.what);
  return has_ended && (event.spec.shutdown_on_exit || event.spec.required);
}

void Outcome::on_process_event(const ProcessEvent& event) {
  failures_.on_process_event(event);
  if (std::holds_alternative<ProcessLeft>(event.what)) {
    exit_code_ = 1;
  }
}

void Outcome::on_end_by(const ProcessEvent& event) {
  if (event.spec.required && std::holds_alternative<ProcessStartFailed>(event.what) && !ignore_failures_) {
    exit_code_ = kExitCodeOfFailedStart;
    return;
  }
  const auto* const exited = std::get_if<ProcessExited>(&event.what);
  if (!event.spec.required || exited == nullptr || exited->expected || ignore_failures_ ||
      event.spec.allowed_exits.contains(exited->exit.code)) {
    return;
  }
  exit_code_ = exited->exit.code > 0 ? exited->exit.code : kExitCodeOfSignal - exited->exit.code;
}

int Outcome::exit_code() const {
  if (exit_code_ != 0) {
    return exit_code_;
  }
  if (hurried_by_ != 0) {
    return kExitCodeOfSignal + hurried_by_;
  }
  return failures_.empty() || ignore_failures_ ? 0 : kExitCodeOfFailures;
}

}  // namespace launch
