// SPDX-License-Identifier: Apache-2.0
// Writes snapshots of a snapshot session when something has gone wrong: what happened before is in them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

struct TakenSnapshot {
  std::vector<std::string> reasons;  // several, when they came while the snapshot before was being taken
  std::filesystem::path directory;   // empty when `error` is not, and over a network
  std::string damage;                // a sentence on events that are missing at its end, or ""
  std::string error;
};

struct SnapshotOrder {
  std::vector<std::string> reasons;
  std::vector<std::string> died = {};  // the processes whose deaths are among them
  std::int64_t moment = 0;  // of the first reason (CLOCK_MONOTONIC, ns), which the snapshot should hold; 0: unknown
};

// Takes a snapshot of the session that `config` describes, and judges it. Blocks for as long as LTTng needs. What is
// wrong is in the result. The others stay, however many there are.
TakenSnapshot take_snapshot(const TraceConfig& config, SnapshotOrder order);

class FlightRecorder {
 public:
  // The session that `config` describes must exist. `told` is called from a thread of the recorder's own.
  FlightRecorder(const TraceConfig& config, std::function<void(const TakenSnapshot&)> told);
  // Takes the snapshots that were requested before.
  ~FlightRecorder();
  FlightRecorder(const FlightRecorder&) = delete;
  FlightRecorder& operator=(const FlightRecorder&) = delete;

  // From any thread; does not block. A reason that is requested again before its snapshot begins is kept once. The
  // snapshot holds every event that was fired before, as far as the buffers reach back. When there are more than
  // TraceConfig::snapshot_limit, the oldest snapshot is removed. `died`: the process whose death is the reason; "":
  // none.
  void request(const std::string& reason, const std::string& died = "");

 private:
  void work();
  TakenSnapshot take(SnapshotOrder order) const;

  TraceConfig config_;
  std::function<void(const TakenSnapshot&)> told_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> requested_;
  std::vector<std::string> died_;  // processes
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tracing
