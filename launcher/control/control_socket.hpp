// SPDX-License-Identifier: Apache-2.0
// The socket of a launch in the runtime directory. Its name is "PID-NUMBER.sock": the process that the user has
// started, and the random number of the launch, because containers may share the directory and have equal PIDs.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/environment/runtime_directory.hpp"

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
  UniqueFd socket;
  bool connected;    // false: it has not taken the connection for some seconds, so it is busy or stopped
  std::string user;  // the owner if that is another user, else ""
};

enum class WhoseLaunches {
  kOwn,
  kAll  // of root: those of all users, else the own ones
};

// Connects to every launch that runs, sorted by process number. Waits some seconds for one that is busy. Removes
// sockets that dead launches have left.
std::vector<FoundLaunch> find_launches(const Environment& environment, WhoseLaunches whose = WhoseLaunches::kOwn);

}  // namespace launch
