// SPDX-License-Identifier: Apache-2.0
// The processes that an agent has been asked to start, as descriptors of this process: a supervisor watches them like
// those of processes here.
//
// The output of a process there goes through a pipe here. Its agent sends only as much as this side has given credit
// for, and credit comes back when the pipe has taken the bytes, so a process that floods its output is slowed down by
// whoever reads it, and holds up nobody else.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class RemoteRuns {
 public:
  using Send = std::function<void(ToAgent kind, const WireWriter& content)>;

  RemoteRuns(EventLoop& loop, Send send) : loop_(loop), send_(std::move(send)) {}

  // Asks the agent to start it. Its pidfd becomes readable when the agent has answered, and then confirm() must be
  // called; afterwards it becomes readable when the process has exited. Throws std::system_error.
  Process start(const ProcessSpec& spec);
  // Throws std::system_error if it could not be started, and forgets it.
  void confirm(Process& process);
  void signal(const Process& process, int signal);
  ProcessExit outcome(const Process& process) const;
  // Forgets it.
  ProcessExit reap(const Process& process);
  // What the agent has said last of the groups of processes that have exited; asks anew. A group that it has said
  // nothing about lives.
  std::vector<bool> groups_live(const std::vector<const Process*>& leaders);

  // A message of the agent about them. Throws WireError for one that it must not send.
  void receive(FromAgent kind, WireReader& reader);
  // The connection is lost: no process is there any more.
  void lose(const std::string& why);

  // "talker-1, listener-2"; those that have not ended.
  std::string running_labels() const;
  // Of a run that has not been reaped; else "a process that has ended".
  std::string label(std::uint32_t number) const;

 private:
  struct Stream {
    UniqueFd pipe;                         // to the supervisor
    std::string waiting;                   // for the pipe
    std::uint32_t taken = 0;               // bytes for which no credit has gone back yet
    std::uint32_t credit = kStreamWindow;  // bytes that the agent may still send
    bool ends = false;                     // no more comes
    EventLoop::SourcePtr source;
  };
  struct Run {
    std::string label;
    UniqueFd event;  // readable: started, failed or exited
    pid_t pid = -1;
    bool answered = false;
    bool confirmed = false;
    std::optional<std::system_error> failure;
    std::optional<ProcessExit> exit;
    bool exit_told = false;
    bool group_lives = true;
    std::array<Stream, 2> streams;
  };

  Run& find(std::uint32_t number);
  static void tell(Run& run);
  void pass_on(std::uint32_t number, Run& run, std::size_t which);
  void give_credit(std::uint32_t number, std::size_t which, Stream& stream, bool at_once);
  void tell_exit(Run& run);

  EventLoop& loop_;
  Send send_;
  std::optional<std::string> lost_;
  std::uint32_t numbers_ = 0;
  std::map<std::uint32_t, std::unique_ptr<Run>> runs_;
};

}  // namespace launch
