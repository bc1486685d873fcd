// SPDX-License-Identifier: Apache-2.0
// A relay daemon that one program has for itself, on free ports of this machine.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "base/files/unique_fd.hpp"

namespace tracing {

// It ends with this object, and with this process however that ends. What it has recorded is removed with it; if this
// process is killed, by the next one that makes such a daemon. To be made while the process has one thread.
class PrivateRelay {
 public:
  // Waits until it listens. Throws std::runtime_error.
  PrivateRelay();
  ~PrivateRelay();
  PrivateRelay(const PrivateRelay&) = delete;
  PrivateRelay& operator=(const PrivateRelay&) = delete;

  // TraceConfig::url of a session that it gets.
  std::string session_url() const;
  // LiveAddress::relay for who reads a session.
  std::string viewer_address() const;

 private:
  enum Port { kControl, kData, kViewers, kPorts };

  void start();
  bool listens() const;
  bool runs_for(std::chrono::milliseconds time) const;  // false when it has ended
  void end();

  std::string directory_;
  launch::UniqueFd lock_;  // on the directory
  std::array<std::uint16_t, kPorts> ports_{};
  pid_t pid_ = -1;
};

}  // namespace tracing
