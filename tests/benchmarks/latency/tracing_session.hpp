// SPDX-License-Identifier: Apache-2.0
// An LTTng session that records every ros2 event, on a session daemon of the benchmark's own.
#pragma once

#include <filesystem>
#include <string>

namespace latency {

// As root the process gets a mount namespace with an empty /run and /dev/shm, hence a daemon and DDS shared memory of
// its own; otherwise the daemon is kept apart by LTTNG_HOME. Make it before anything that registers with the daemon.
class TracingSession {
 public:
  TracingSession();
  ~TracingSession();
  TracingSession(const TracingSession&) = delete;
  TracingSession& operator=(const TracingSession&) = delete;

  // They return when the tracepoints of all processes are switched.
  void start();
  void stop();

 private:
  void run(const std::string& command);

  std::filesystem::path directory_;
};

}  // namespace latency
