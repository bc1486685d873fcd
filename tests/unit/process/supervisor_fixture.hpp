// SPDX-License-Identifier: Apache-2.0
// A supervisor on fakes that notes the events that its observers get.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "memory_screen.hpp"

namespace launch {

// One line for each event: "0.0 a-1 started", seconds of virtual time in front.
class EventText {
 public:
  EventText(const EventLoop& loop, std::vector<std::string>& lines) : loop_(loop), lines_(lines) {}

  void operator()(const ProcessEvent& event) const {
    const double seconds = std::chrono::duration<double>(loop_.now()).count();
    lines_.push_back(fmt::format("{:.1f} {} {}", seconds, event.label, std::visit(EventText(*this), event.what)));
  }
  std::string operator()(const ProcessStarted&) const { return "started"; }
  std::string operator()(const ProcessStartFailed& failed) const {
    return fmt::format("failed: {}{}", failed.reason, failed.will_respawn ? ", again" : "");
  }
  std::string operator()(const ProcessExited& exited) const {
    return fmt::format("exited {}{}{}", exited.exit.code, exited.expected ? ", expected" : "",
                       exited.will_respawn ? ", again" : "");
  }
  std::string operator()(const SignalSent& sent) const {
    if (sent.escalated_from == 0) {
      return fmt::format("SIG{}", ::sigabbrev_np(sent.signal));
    }
    return fmt::format("SIG{} after SIG{} and {} s", ::sigabbrev_np(sent.signal), ::sigabbrev_np(sent.escalated_from),
                       std::chrono::duration<double>(sent.waited).count());
  }
  std::string operator()(const SchedulingChanged& change) const { return "scheduling" + change.failure; }
  std::string operator()(const ProcessLeft& left) const { return left.foreign ? "left, foreign" : "left"; }
  std::string operator()(const ProcessWaitsForTerminal& waits) const {
    return fmt::format("waits for the terminal{}", waits.has_terminal ? ", which it has" : "");
  }
  std::string operator()(const RespawnSlowed& slowed) const { return fmt::format("slowed after {} runs", slowed.runs); }
  std::string operator()(const HealthChanged& change) const {
    return change.health == Health::kUnhealthy ? "unhealthy: " + change.reason : "healthy";
  }
  std::string operator()(const StartLimitReached& reached) const {
    return fmt::format("{} starts reached{}", reached.starts, reached.cool_down ? ", cools down" : "");
  }
  std::string operator()(const ProcessDone&) const { return "done"; }

 private:
  const EventLoop& loop_;
  std::vector<std::string>& lines_;
};

class SupervisorFixture : public testing::Test {
 protected:
  using Lines = std::vector<std::string>;

  SupervisorFixture() {
    supervisor->observe([this](const ProcessEvent& event) { EventText(loop, lines)(event); });
  }

  static ProcessSpec spec(const std::string& name) {
    ProcessSpec result;
    result.name = name;
    result.argv = {"/bin/" + name};
    result.output = *OutputRouting::from_mode("screen");
    return result;
  }

  // The lines since the last call.
  Lines take_lines() { return std::exchange(lines, {}); }
  pid_t pid_of_start(std::size_t number) const { return runner.spawned().at(number).pid; }

  Lines lines;
  MemoryScreen screen;
  FakeEventLoop loop;
  FakeProcessRunner runner{loop};
  OutputRouter output{{.screen_fd = screen.fd()}};
  std::unique_ptr<ProcessSupervisor> supervisor = std::make_unique<ProcessSupervisor>(loop, runner, output);
};

}  // namespace launch
