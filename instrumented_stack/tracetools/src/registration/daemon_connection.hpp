// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <vector>

namespace tracetools {

// A socket of liblttng-ust that is connected to a session daemon.
class DaemonConnection {
 public:
  DaemonConnection(int descriptor, pid_t daemon) : descriptor_(descriptor), daemon_(daemon) {}

  pid_t daemon() const { return daemon_; }
  void shut_down() const;
  // An answer of the daemon is waited for as long as LTTng does by itself.
  void use_default_timeout() const;

 private:
  int descriptor_;
  pid_t daemon_;
};

// Those of this process, found by the name of the socket at the other end.
std::vector<DaemonConnection> daemon_connections();

}  // namespace tracetools
