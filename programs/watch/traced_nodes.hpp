// SPDX-License-Identifier: Apache-2.0
// A live session that records all nodes, for one program, with the relay daemon that gets it.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "programs/watch/private_relay.hpp"
#include "tracing/decode/reader/live_reader.hpp"

namespace tracing {

// The session ends with this object, and with this process however that ends: `launch trace` holds it, which ends it
// with its input. To be made while the process has one thread.
class TracedNodes {
 public:
  struct Settings {
    std::string name = "launch-top";                // the first part of that of the session
    std::vector<std::string> events = {"ros2:*"};   // of userspace
    std::chrono::microseconds live_timer{200'000};  // what is recorded can be read so late
  };
  // Throws std::runtime_error or TraceReadError, whose text may have a second line that says what to do.
  explicit TracedNodes(Settings settings);
  ~TracedNodes();
  TracedNodes(const TracedNodes&) = delete;
  TracedNodes& operator=(const TracedNodes&) = delete;

  // Gives what is recorded.
  LiveReader& reader() { return reader_; }
  // Lets the nodes tell of their objects again if the reader has missed some. To be called now and then.
  void catch_up();
  // Returns when all is recorded.
  void end();

 private:
  void start();
  void attach();
  bool is_recorded_for(std::chrono::milliseconds time) const;

  Settings settings_;
  PrivateRelay relay_;
  std::string session_;
  pid_t recorder_ = -1;
  launch::UniqueFd alive_;     // the recorder's input
  launch::UniqueFd problems_;  // its errors
  LiveReader reader_;
  std::size_t caught_up_ = 0;  // late attachments of the reader
};

}  // namespace tracing
