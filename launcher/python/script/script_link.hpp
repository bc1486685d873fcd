// SPDX-License-Identifier: Apache-2.0
// The connection with a Python program whose LaunchService has started this launcher (launch/_script/_link.py).
//
// Messages are JSON, one a line. The launcher calls; while it waits for the result, the script may call back.
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/environment/environment.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {

// What the environment of the launcher says about the script: its connection, and the descriptor by which it asks for a
// turn. Only the process that carries the launch out may use it.
struct ScriptOrder {
  int socket = -1;
  int wake = -1;
  pid_t script = -1;

  // Takes the order out of both environments, the map and that of this process. nullopt when no script has started this
  // launcher. Programs that are started from now on don't inherit the descriptors. Throws std::runtime_error.
  static std::optional<ScriptOrder> take(Environment& environment);
};

class ScriptLink {
 public:
  using Json = nlohmann::json;

  // Throws std::system_error.
  explicit ScriptLink(const ScriptOrder& order);

  // Both throw std::runtime_error when the script has ended.
  void send(const Json& message);
  Json receive();

  // Readable when the script wants a turn, or has ended.
  int descriptor() const { return epoll_.get(); }
  // Forgets what asked for a turn until now.
  void take_wishes();

 private:
  UniqueFd socket_;
  UniqueFd wake_;
  UniqueFd script_;  // a pidfd: a process that the script has forked could hold its end of the socket
  UniqueFd epoll_;
  std::string received_;
};

}  // namespace launch
