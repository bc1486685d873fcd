// SPDX-License-Identifier: Apache-2.0
// The connection to the agent on one machine: it begins, answers questions, starts processes, and tells when it is
// lost.
//
// A launch file is visited without the loop, so what a visit asks is waited for here. Everything else goes through the
// loop. What the agent sends is not trusted: bytes that are no message of the protocol end the connection.
//
// A connection that is kept may be cut: its machine is away then, what is sent waits, and the command is started again
// until it has brought the launcher back to the agent (machine_loss.cpp). Otherwise a connection that is cut is lost.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/machines/clock_offset.hpp"
#include "launcher/machines/connecting_command.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/machines/protocol/kept_frames.hpp"
#include "launcher/machines/protocol/outgoing.hpp"
#include "launcher/machines/remote_runs.hpp"
#include "launcher/machines/remote_traces.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/visit/machines.hpp"

namespace launch {

// A connection that was not made, or is lost, in one line; and what to do about it.
class MachineError : public std::runtime_error {
 public:
  MachineError(const std::string& what, std::string help_text) : std::runtime_error(what), help(std::move(help_text)) {}
  std::string help;
};

class MachineConnection {
 public:
  struct Settings {
    std::string name;                // of the machine
    std::string connect;             // as it was written, for messages
    std::vector<std::string> words;  // of the command, those of the agent at the end
    std::string setup;
    Duration keepalive{0};        // a connection that is silent for so long is lost
    Duration connect_timeout{0};  // until the agent must have told of its machine
    Duration grace{0};            // without `keep`: what runs there goes on for so long when the connection is cut
    bool keep = false;
    Duration keep_for{0};  // so long what runs there goes on without the launcher
    std::string launch_version;
  };
  using Tell = std::function<void(LogLevel level, const std::string& text)>;

  // Starts the command; a command that can't be started is told by await_hello(). The loop must outlive the connection.
  MachineConnection(EventLoop& loop, Settings settings, Tell tell);
  // Asks the agent to end what is left there, and waits until it has.
  ~MachineConnection();
  MachineConnection(const MachineConnection&) = delete;
  MachineConnection& operator=(const MachineConnection&) = delete;

  // Waits until the agent has told of its machine; at once if it has. Throws MachineError.
  const AgentHello& await_hello();
  // Waits for an answer. Throws MachineError if the connection is lost, and std::runtime_error with the agent's words
  // when the answer is that it did not work.
  std::string ask(AgentQuestion what, const WireWriter& content);

  const std::string& name() const { return settings_.name; }
  bool is_lost() const { return lost_.has_value(); }
  // "the connection to machine 'arm' is lost: …"
  const std::string& why_lost() const { return *lost_; }

  // By the loop, once; what ran there has not ended yet for the supervisor. Not for a connection that was never made.
  // With `keep` each time that the machine is away from now on.
  void observe_loss(std::function<void(const LostMachine&)> observer) { observe_loss_ = std::move(observer); }
  void observe_return(std::function<void(const ReturnedMachine&)> observer) { observe_return_ = std::move(observer); }

  bool is_away() const { return away_ != nullptr; }
  // The launch ends: from now on the machine may be away for a few seconds only, before it is lost.
  void expect_end();

  // For the process runner (machine_runner.cpp). What is sent to a lost connection is dropped.
  RemoteRuns& runs() { return runs_; }
  RemoteTraces& traces() { return traces_; }
  void send(ToAgent kind, const WireWriter& content = {});

  // The launcher is stopped from now on, or goes on.
  void suspend(bool stops);
  // By another thread: tells the agent that the launcher is there.
  void ping();

 private:
  using Clock = std::chrono::steady_clock;
  // A machine whose connection is kept, and cut now.
  struct Away {
    std::string why;
    Clock::time_point begin;
    Clock::time_point end;  // then it is lost
    Duration pause{0};      // before the next try
    std::string last;       // why the last try has failed
    bool gone = false;      // the agent
    EventLoop::SourcePtr timer{};
  };

  // Waits until `done` says so, no longer than `limit` from `begin` on. Throws MachineError; `what` says what is
  // missing.
  void wait_until(const std::function<bool()>& done, Clock::time_point begin, Duration limit, const std::string& what);
  // Starts the command. Throws SpawnError.
  void start_command();
  void receive();
  void take_greeting();
  void send_setup();
  void dispatch(const Frame& frame);
  void take_pong(WireReader& reader);
  void watch_output();
  void watch_silence();
  // What the command connected is no more; returns how the command has ended.
  std::string end_command(bool by_itself);
  // The connection is no more, for good unless it is kept. `reason` says why, if it is known better than by the end of
  // the command.
  void cut(const std::string& reason);
  // It is no more, for good.
  void lose(const std::string& reason, std::string help = {});
  void be_away(const std::string& why);
  void try_later();
  void try_again();
  void await_greeting();
  void come_back(WireReader& reader);
  void acknowledge(bool at_once);
  // Passes on a line that the command has written to its standard error.
  std::function<void(std::string_view line)> teller() const;
  std::string last_words() const;
  std::string last_words_of_agent() const;
  std::string who_ends_it(const Away* away) const;
  [[noreturn]] void throw_lost() const;

  EventLoop& loop_;
  Settings settings_;
  Tell tell_;
  std::function<void(const LostMachine&)> observe_loss_ = [](const LostMachine&) {};
  std::function<void(const ReturnedMachine&)> observe_return_ = [](const ReturnedMachine&) {};
  std::unique_ptr<ConnectingCommand> command_;
  std::unique_ptr<Outgoing> outgoing_;
  RemoteRuns runs_;
  ClockOffset clock_;
  int more_pings_ = 0;  // each follows the answer to the one before
  RemoteTraces traces_;

  std::string before_greeting_;
  bool greeted_ = false;
  std::optional<AgentHello> hello_;
  Frames frames_;
  std::optional<std::string> lost_;
  std::string help_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point last_heard_ = Clock::now();
  bool suspended_ = false;

  // Of a connection that is kept.
  AgentSetup setup_;
  KeptFrames kept_;
  ReceivedFrames received_;
  std::unique_ptr<Away> away_;  // null: there is a connection, or none any more
  bool ends_ = false;           // the launch
  std::atomic<bool> expects_pings_ = false;

  struct Answer {
    bool well;
    std::string text;
  };
  std::uint32_t questions_ = 0;
  std::map<std::uint32_t, std::optional<Answer>> answers_;
  std::set<std::uint32_t> unawaited_;  // questions whose answers come too late

  EventLoop::SourcePtr output_source_;
  EventLoop::SourcePtr error_source_;
  EventLoop::SourcePtr write_source_;
  EventLoop::SourcePtr silence_timer_;
};

}  // namespace launch
