// SPDX-License-Identifier: Apache-2.0
// What an agent tells of its machine: its environment and packages, and answers to what the visit of a launch file
// asks.
#pragma once

#include <functional>
#include <string>

#include "base/environment/environment.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

// The environment of this process, after the file has been sourced by the shell that its name tells (.bash, .zsh; sh
// for another one). What the file prints goes to standard error. Throws std::runtime_error.
Environment environment_after(const std::string& setup);

AgentHello describe_machine(const Environment& environment);

class MachineQuestions {
 public:
  using Done = std::function<void(bool well, const std::string& text)>;

  // The loop must not be destroyed before the process ends: a thread waits for a command.
  MachineQuestions(EventLoop& loop, const Environment& environment);

  // Answers a question, whose kind comes first, now or in a later turn of the loop. Throws WireError.
  void answer(WireReader& reader, Done done);

 private:
  void run(WireReader& reader, Done done);

  EventLoop& loop_;
  PackageIndex packages_;
};

}  // namespace launch
