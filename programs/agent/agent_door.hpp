// SPDX-License-Identifier: Apache-2.0
// Where a launcher whose connection was cut finds its agent again: a socket in the runtime directory of the user, which
// nobody else can enter.
//
// Its name can't be guessed, who knocks must be a process of the same user, and must say what only the launcher and the
// agent know. What says something else is turned away.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <string>

#include "base/environment/runtime_directory.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

// "agent-0123…"
std::string name_of_door(const std::string& id);
// Whether the process at the other end of a Unix socket belongs to the user of this process.
bool is_of_this_user(int socket);

class AgentDoor {
 public:
  // A launcher has come back, and has got so many numbered frames.
  using Enter = std::function<void(UniqueFd connection, std::uint64_t received)>;

  // Throws std::system_error. The guardian of the agent removes the socket when all has ended (path()).
  AgentDoor(EventLoop& loop, const Environment& environment, const std::string& id, std::string key, Enter enter);

  const std::string& path() const { return path_; }

 private:
  struct Visitor {
    UniqueFd connection;
    Frames frames{};
    EventLoop::SourcePtr source{};
    EventLoop::SourcePtr patience{};
  };

  void open_for_one();
  void listen_to(std::list<Visitor>::iterator visitor);

  EventLoop& loop_;
  std::string key_;
  Enter enter_;
  std::string path_;
  UniqueFd socket_;
  EventLoop::SourcePtr source_;
  std::list<Visitor> visitors_;
};

}  // namespace launch
