// SPDX-License-Identifier: Apache-2.0
// Watches what a recording depends on, while the system runs. Also puts the counts of ended processes away
// (event_counters.hpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

class HeldUpStreams;
class RelayConnection;
struct HeldUpStream;

class RunWatch {
 public:
  // The session of `config` records. Calls `told` from a thread of its own with a sentence, within a second, when
  //   - the session daemon ends or is stopped,
  //   - its consumer ends or is stopped,
  //   - the recorder of kernel events ends before the session does,
  //   - the file system of the trace is full,
  //   - the relay daemon that gets the trace closes its connections, or takes nothing any more,
  //   - a process of which process_ended() was told has died within an event and holds up streams.
  // Each is said once, and again only after it was over.
  RunWatch(const TraceConfig& config, std::function<void(const std::string&)> told);
  ~RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;

  // From any thread; does not block. Without it nobody looks at the streams.
  void process_ended(const std::string& name);

 private:
  struct EndedProcess {
    std::string name;
    std::uint64_t time;  // CLOCK_MONOTONIC, ns
  };

  void watch();
  // Returns when it is to be called again, if at all.
  std::optional<std::chrono::steady_clock::time_point> look_at_streams(const std::vector<EndedProcess>& ended);
  std::string streams_are_held_up(const std::vector<HeldUpStream>& streams) const;
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
  std::unique_ptr<HeldUpStreams> streams_;  // null: a process holds up none but its own
  std::vector<EndedProcess> lately_ended_;  // since the streams were settled
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<EndedProcess> ended_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tracing
