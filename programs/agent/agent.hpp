// SPDX-License-Identifier: Apache-2.0
// The agent of a launch on another machine: starts processes, passes on what they print, and tells how they end
// (agent_protocol.hpp). What is to be done is decided by the launcher.
//
// When the launcher has gone, whatever the reason, the agent ends, and its guardian ends what it has left.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/machines/protocol/outgoing.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/spawn/generated_files.hpp"
#include "programs/agent/agent_traces.hpp"
#include "programs/agent/machine_questions.hpp"

namespace launch {

class Agent {
 public:
  // The descriptors lead to the launcher. All references must outlive the agent. Writes the greeting.
  Agent(EventLoop& loop, ProcessRunner& runner, Guardian& guardian, UniqueFd in, UniqueFd out,
        const std::string& launch_version);

  // Works until the launcher has gone or has said that it is the end. Returns the exit code.
  int run();

 private:
  using Clock = std::chrono::steady_clock;
  struct Stream {
    UniqueFd fd;
    EventLoop::SourcePtr source;
    std::uint32_t credit = kStreamWindow;
    bool drained = false;  // after the exit: what was there is read
  };
  struct Run {
    Process process;
    std::string label;
    std::array<Stream, 2> streams;
    EventLoop::SourcePtr exit_source;
    Duration started{0};
    bool signalled = false;
    std::optional<ProcessExit> exit;
    bool exit_told = false;
  };

  void receive();
  void dispatch(const Frame& frame);
  void set_up(const AgentSetup& setup);
  void start(WireReader& reader);
  void signal(WireReader& reader);
  void take_credit(WireReader& reader);
  void release(WireReader& reader);
  void tell_groups(WireReader& reader);
  void watch_silence();
  void pump(std::uint32_t number, std::size_t which);
  void on_exit(std::uint32_t number);
  void tell_exit(std::uint32_t number, Run& run);
  void send(FromAgent kind, const WireWriter& content = {});
  void on_writable();
  void end(int code);

  EventLoop& loop_;
  ProcessRunner& runner_;
  Guardian& guardian_;
  UniqueFd in_;
  Outgoing out_;
  Frames frames_;
  GeneratedFiles files_;
  std::optional<MachineQuestions> questions_;  // once it is set up
  AgentTraces traces_;
  std::map<std::uint32_t, Run> runs_;
  std::uint32_t last_run_ = 0;
  Duration silence_{0};
  Clock::time_point last_heard_ = Clock::now();
  bool launcher_stopped_ = false;
  bool stalled_ = false;  // the connection takes nothing now, so nothing is read
  int exit_code_ = 0;

  EventLoop::SourcePtr in_source_;
  EventLoop::SourcePtr out_source_;
  EventLoop::SourcePtr signal_source_;
  EventLoop::SourcePtr silence_timer_;
};

}  // namespace launch
