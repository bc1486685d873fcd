// SPDX-License-Identifier: Apache-2.0
// The traces of a launch on the machine of an agent: a session of its own for each, whose recording the launcher
// fetches. The guardian of the agent ends the session when the agent can't.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/environment/environment.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class AgentTraces {
 public:
  using Send = std::function<void(FromAgent kind, const WireWriter& content)>;

  // The loop must not be destroyed before the process ends: threads wait for LTTng. The guardian must outlive this.
  AgentTraces(EventLoop& loop, Guardian& guardian, Send send);
  ~AgentTraces();
  AgentTraces(const AgentTraces&) = delete;
  AgentTraces& operator=(const AgentTraces&) = delete;

  // The environment of the machine, which tells where recordings go.
  void use_environment(const Environment& environment) { environment_ = environment; }

  // A message about a trace. Throws WireError.
  void receive(ToAgent kind, WireReader& reader);

  // Changes the spec of a process that is about to start.
  void prepare(ProcessSpec& spec);
  void started(pid_t pid);
  // `code`: its exit code, -N for signal N. `asked_for`: the launcher has sent it a signal.
  void ended(const std::string& name, pid_t pid, std::int32_t code, bool asked_for);

 private:
  struct Recording;
  struct Trace;

  void begin(std::uint32_t number, WireReader& reader);
  void end(const std::shared_ptr<Trace>& trace);
  // Throws WireError if it is one of before. The numbers grow.
  std::uint32_t take_number(std::uint32_t number);
  void take_snapshot(const std::shared_ptr<Trace>& trace, WireReader& reader);
  void tell_ended(std::uint32_t number, bool well, const std::string& error, const std::string& remedy,
                  const std::string& directory);
  void fetch(const std::shared_ptr<Recording>& recording, std::uint32_t credit);
  void send_files(const std::shared_ptr<Recording>& recording);
  void leave(std::uint32_t number, bool remove);
  // Runs `work` on a thread of its own, then `finished` in the loop, with what is wrong and what helps.
  void in_background(std::function<void()> work, std::function<void(bool well, std::string, std::string)> finished);

  EventLoop& loop_;
  Guardian& guardian_;
  Send send_;
  Environment environment_;
  std::shared_ptr<bool> lives_ = std::make_shared<bool>(true);  // read and written in the loop alone
  std::uint32_t last_ = 0;
  std::map<std::uint32_t, std::shared_ptr<Trace>> traces_;
  std::map<std::uint32_t, std::shared_ptr<Recording>> recordings_;
};

}  // namespace launch
