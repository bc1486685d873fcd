// SPDX-License-Identifier: Apache-2.0
// The socket of a launch in the runtime directory. Its name is "PID-NUMBER.sock": the process that the user has
// started, and the random number of the launch, because containers may share the directory and have equal PIDs.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "launcher/control/runtime_directory.hpp"

namespace launch {

class Guardian;

// Listens until it is destroyed, which removes the socket. When the launcher is killed, the guardian removes it.
class ControlSocket {
 public:
  // Throws std::system_error. The guardian must outlive the socket.
  ControlSocket(RuntimeDirectory directory, Guardian& guardian);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  const UniqueFd& fd() const { return fd_; }
  std::string path() const { return directory_.path + "/" + name_; }

 private:
  RuntimeDirectory directory_;
  Guardian& guardian_;
  std::string name_;
  UniqueFd fd_;
  std::int32_t clean_up_ = 0;
};

// A launch that has a socket.
struct FoundLaunch {
  pid_t pid;         // of the process that the user has started
  std::string path;  // of the socket
  UniqueFd socket;   // connected
};

// Connects to every launch of this user that runs, sorted by process number. Removes sockets that dead launches have
// left.
std::vector<FoundLaunch> find_launches(const Environment& environment);

}  // namespace launch
