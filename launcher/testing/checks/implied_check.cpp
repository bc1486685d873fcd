// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/checks/implied_check.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>

#include "base/processes/ending_signals.hpp"
#include "launcher/testing/checks/check.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

void ImpliedCheck::on_process(const ProcessEvent& event) {
  if (const auto* const failed = std::get_if<ProcessStartFailed>(&event.what)) {
    if (!is_left_out(event)) {
      fail(event, fmt::format("{} can't be started: {}", event.label, failed->reason));
    }
  } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    const Kill kill = take_kill(event, exited->exit.code);
    if (kill == Kill::kExpected) {
      return;
    }
    const bool is_expected = exited->expected && kill == Kill::kNone;
    const bool by_itself = !is_expected && exited->exit.code != 0 && !exited->will_respawn;
    if ((by_itself || tells_of_a_crash(-exited->exit.code)) && !is_left_out(event)) {
      fail(event, fmt::format("{} has exited with {}", event.label, exit_text(exited->exit.code)),
           is_expected ? std::string()
                       : fmt::format("if that is right: <exit process=\"{}\" code=\"{}\"/>", event.spec.name,
                                     exited->exit.code));
    }
  } else if (std::holds_alternative<SignalSent>(event.what)) {
    if (const auto killed = killed_.find(event.label); killed != killed_.end()) {
      ++killed->second.sent;
    }
  } else if (const auto* const left = std::get_if<ProcessLeft>(&event.what)) {
    fail(event, fmt::format("{} can't be ended: its pid is {}", event.label, left->pid));
  }
}

ImpliedCheck::Kill ImpliedCheck::take_kill(const ProcessEvent& event, int code) {
  const auto found = killed_.find(event.label);
  if (found == killed_.end()) {
    return Kill::kNone;
  }
  const Killed killed = found->second;
  killed_.erase(found);
  if (code == -killed.signal || (code == 0 && asks_to_end(killed.signal))) {
    return Kill::kExpected;
  }
  return killed.sent > 1 ? Kill::kNone : Kill::kOther;
}

bool ImpliedCheck::is_left_out(const ProcessEvent& event) const {
  std::vector<std::string> names = names_of(event.spec);
  names.push_back(event.label);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(left_out_.begin(), left_out_.end(), name) != left_out_.end();
  });
}

void ImpliedCheck::fail(const ProcessEvent& event, std::string message, std::string help) {
  Failure failure{std::move(message), event.spec.origin};
  failure.help = std::move(help);
  tail_.show(failure, {event.label});
  failed_(std::move(failure));
}

}  // namespace launch
