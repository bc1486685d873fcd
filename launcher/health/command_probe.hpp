// SPDX-License-Identifier: Apache-2.0
// Whether a command ends with exit code 0. It runs where the process runs: in its environment, its directory and its
// namespaces.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {

class CommandProbe final : public HealthProbe {
 public:
  // `answer` gets what the command says, later than the look that has started it. The references must outlive the
  // probe.
  CommandProbe(EventLoop& loop, ProcessRunner& runner, ProcessSpec command, Duration timeout,
               std::function<void(const Look&)> answer)
      : loop_(loop), runner_(runner), command_(std::move(command)), timeout_(timeout), answer_(std::move(answer)) {}
  ~CommandProbe() override;
  CommandProbe(const CommandProbe&) = delete;
  CommandProbe& operator=(const CommandProbe&) = delete;

  void begin(pid_t) override {}
  // A command that still runs is killed: what it would say is about a process that has ended.
  void end() override { abandon(); }
  // Starts the command, unless it still runs.
  Look look(Duration now, Duration passed) override;

 private:
  struct Run;

  void read();
  void on_exit();
  void on_timeout();
  void abandon();
  std::string last_words() const;

  EventLoop& loop_;
  ProcessRunner& runner_;
  ProcessSpec command_;
  Duration timeout_;
  std::function<void(const Look&)> answer_;
  std::shared_ptr<Run> run_;
  std::vector<std::shared_ptr<Run>> abandoned_;  // killed, and not reaped yet
};

}  // namespace launch
