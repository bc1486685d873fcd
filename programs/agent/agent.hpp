// SPDX-License-Identifier: Apache-2.0
// The agent of a launch on another machine: starts processes, passes on what they print, and tells how they end
// (agent_protocol.hpp). What is to be done is decided by the launcher.
//
// When the launcher has gone, whatever the reason, the agent ends, and its guardian ends what it has left. If it was
// told to wait, it goes on for a limited time first, and the launcher can come back meanwhile (agent_connection.cpp).
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/machines/protocol/kept_frames.hpp"
#include "launcher/machines/protocol/outgoing.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/spawn/generated_files.hpp"
#include "programs/agent/agent_door.hpp"
#include "programs/agent/agent_traces.hpp"
#include "programs/agent/machine_questions.hpp"
#include "programs/agent/output_spool.hpp"

namespace launch {

class Agent {
 public:
  // The descriptors lead to the launcher. All references must outlive the agent. Writes the greeting.
  Agent(EventLoop& loop, ProcessRunner& runner, Guardian& guardian, UniqueFd in, UniqueFd out,
        const std::string& launch_version);

  // Works until the launcher has gone or has said that it is the end. Returns the exit code.
  int run();

  // What the launcher has asked for in place of an agent: to come back to the one that waits for it (agent_relay.hpp).
  struct Return {
    std::string request;
    UniqueFd in;
    UniqueFd out;
  };
  // After run(); nothing if it has not.
  std::optional<Return> take_return();

 private:
  using Clock = std::chrono::steady_clock;
  struct Stream {
    UniqueFd fd;
    EventLoop::SourcePtr source;
    std::uint32_t credit = kStreamWindow;
    bool drained = false;  // after the exit: what was there is read
    bool closed = false;   // it was told that nothing more comes
    OutputSpool spool;
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
  void pump(std::uint32_t number, std::size_t which);
  void pump_all();
  void send_output(std::uint32_t number, std::size_t which, std::string_view bytes);
  void on_exit(std::uint32_t number);
  void tell_exit(std::uint32_t number, Run& run);
  void listen();
  void watch_silence();
  void send(FromAgent kind, const WireWriter& content = {});
  void on_writable();
  void acknowledge(bool at_once);
  // The connection is no more; in one line.
  void lose(const std::string& why);
  void leave_connection();
  void come_back(UniqueFd connection, std::uint64_t received);
  void note(const std::string& text);
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
  std::size_t spooled_ = 0;  // bytes of all streams
  std::uint32_t last_run_ = 0;
  Duration silence_{0};
  Clock::time_point last_heard_ = Clock::now();
  bool launcher_stopped_ = false;
  bool stalled_ = false;  // the connection takes nothing now, so nothing is read
  int exit_code_ = 0;
  std::optional<Return> return_;

  // Of a connection that may be lost without the end of what runs.
  AgentSetup setup_;
  std::optional<AgentDoor> door_;   // there is one if a launcher may come back
  std::optional<KeptFrames> kept_;  // the same
  ReceivedFrames received_;
  bool away_ = false;  // there is no connection now
  std::string log_;    // its path, once something was noted
  EventLoop::SourcePtr wait_timer_;

  EventLoop::SourcePtr in_source_;
  EventLoop::SourcePtr out_source_;
  EventLoop::SourcePtr signal_source_;
  EventLoop::SourcePtr silence_timer_;
};

}  // namespace launch
