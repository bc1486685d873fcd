// SPDX-License-Identifier: Apache-2.0
// How many events the processes of a launch have fired, as they say themselves while they run: the counter files of
// libtracetools (docs/tracetools.md).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tracing/record/account/event_counts.hpp"

namespace tracing {

// What libtracetools looks for in the environment of a process.
inline constexpr const char* kEventCountersVariable = "TRACETOOLS_EVENT_COUNTERS";

// Reads the files of a directory, again and again.
class EventCounters {
 public:
  explicit EventCounters(std::filesystem::path directory);
  ~EventCounters();
  EventCounters(const EventCounters&) = delete;
  EventCounters& operator=(const EventCounters&) = delete;

  // The counts of all processes, ended or not, in the order of their start. Files stay mapped, so that another call
  // costs some microseconds for each process. Not for several threads at once.
  std::vector<EventCounts> read();

  // Moves the counts of processes that have ended into one small file, and removes the files of these processes, 38 KiB
  // each. Call it every few seconds while the launch runs; any thread. It also keeps the directory from being taken for
  // that of a killed launch (counter_directory.hpp).
  static void put_ended_processes_away(const std::filesystem::path& directory);

 private:
  class File;

  std::filesystem::path directory_;
  std::map<std::string, std::unique_ptr<File>> files_;  // by name
};

}  // namespace tracing
