// SPDX-License-Identifier: Apache-2.0
// The connection over which a consumer sends a trace to a relay daemon.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tracing {

// The TCP ports of a relay daemon.
struct RelayPorts {
  std::uint16_t control = 5342;
  std::uint16_t data = 5343;
};

// Of net://HOST[:CONTROL[:DATA]], and of the path that the session daemon tells of a session:
// "tcp4://HOST:CONTROL/… [data: DATA]". What is not given is the default.
RelayPorts relay_ports(const std::string& address);

// The relay daemons in the network namespace of `process` that are stopped (SIGSTOP); none if another one runs there:
// which of them is connected, is unknown.
std::vector<pid_t> stopped_relay_daemons(pid_t process);

// The connections of consumers to the relay daemon at these ports. A session that sends its trace there has them from
// the creation of its first channel on.
class RelayConnection {
 public:
  RelayConnection(RelayPorts ports, std::vector<pid_t> consumers) : ports_(ports), consumers_(std::move(consumers)) {}

  enum class State {
    kUnknown,  // the consumer is another user's
    kWorks,
    kEnded,  // there is no connection any more
    kSilent  // the relay daemon runs on this machine and is stopped, or it has taken nothing for kLongestSilence looks
  };
  // Call it twice a second.
  State look();
  // The relay daemon at the other end if it runs on this machine and is stopped.
  std::vector<pid_t> stopped_daemons() const;

  static constexpr int kLongestSilence = 10;

 private:
  RelayPorts ports_;
  std::vector<pid_t> consumers_;
  int silence_ = 0;  // looks
};

}  // namespace tracing
