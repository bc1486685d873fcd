// SPDX-License-Identifier: Apache-2.0
// Watches what a recording depends on, while the system runs. Also puts the counts of ended processes away
// (event_counters.hpp).
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

class RelayConnection;

class RunWatch {
 public:
  // The session of `config` records. Calls `told` from a thread of its own with a sentence, within a second, when
  //   - the session daemon ends or is stopped,
  //   - its consumer ends or is stopped,
  //   - the recorder of kernel events ends before the session does,
  //   - the file system of the trace is full,
  //   - the relay daemon that gets the trace closes its connections, or takes nothing any more.
  // Each is said once, and again only after it was over.
  RunWatch(const TraceConfig& config, std::function<void(const std::string&)> told);
  ~RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;

 private:
  void watch();
  void look_at_daemon();
  void look_at_consumers();
  void look_at_kernel_recorder();
  void look_at_room();
  void look_at_relay_daemon();
  void look_at_counters();
  // Says the sentence when `is_so` begins.
  void say(bool is_so, const std::string& sentence);

  std::filesystem::path directory_;  // of the trace; empty: a relay daemon gets it
  std::string address_;              // of the relay daemon
  std::filesystem::path counters_;   // empty: no process counts
  std::function<void(const std::string&)> told_;
  int looks_ = 0;
  pid_t daemon_;
  std::vector<pid_t> consumers_;
  pid_t kernel_recorder_;
  std::unique_ptr<RelayConnection> relay_;
  std::set<std::string> said_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tracing
