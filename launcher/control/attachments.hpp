// SPDX-License-Identifier: Apache-2.0
// Clients that are attached to the terminals of processes: what a process prints goes to all of them, and each may type
// there. They can't hold a process up: one that reads too slowly loses output, and is told so.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>

#include "launcher/control/control_protocol.hpp"
#include "launcher/control/control_server.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace launch {

class Attachments {
 public:
  using ClientId = ControlServer::ClientId;

  // Both must outlive this object.
  Attachments(ProcessSupervisor& supervisor, ControlServer& server) : supervisor_(supervisor), server_(server) {}
  ~Attachments();
  Attachments(const Attachments&) = delete;
  Attachments& operator=(const Attachments&) = delete;

  // Each answers the client. The answer to what is typed comes when the terminal has taken it.
  void attach(ClientId client, const SteeredProcess& process, const ControlRequest& request);
  void type(ClientId client, std::string text);
  void resize(ClientId client, const TerminalSize& size);

  // The queue of the client has room again.
  void on_room(ClientId client);
  void forget(ClientId client);
  void on_event(const ProcessEvent& event);

 private:
  struct Attached {
    ProcessId process;
    bool read_only;
    TerminalSize size;  // none: the client has no terminal
    std::size_t dropped = 0;
  };
  struct Typed {
    ClientId client;
    std::string text;
    std::size_t taken = 0;
  };

  void on_output(ProcessId process, std::string_view bytes);
  void show_rest(ClientId client, Attached& attached);
  std::string picture(const Attached& attached) const;
  void type_on(ProcessId process);
  void end(const ProcessEvent& event, const ProcessExited* exited);
  void watch(ProcessId process);
  std::size_t clients_of(ProcessId process) const;

  ProcessSupervisor& supervisor_;
  ControlServer& server_;
  std::map<ClientId, Attached> attached_;
  std::map<ProcessId, std::deque<Typed>> typed_;  // what the terminal has not taken yet, in this order
};

}  // namespace launch
