// SPDX-License-Identifier: Apache-2.0
// How many events the processes of a launch have fired, as they say themselves while they run: the counter files of
// libtracetools (docs/tracetools.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace tracing {

// How many events one process has fired, as it says itself.
struct EventCounts {
  std::int64_t pid = 0;
  std::string process;                          // the name of its program
  std::uint64_t begin = 0;                      // CLOCK_MONOTONIC, ns
  std::uint64_t end = 0;                        // 0: it runs, or was killed
  std::uint64_t cpu = 0;                        // ns of processor time until `end`
  std::uint64_t reached = 0;                    // when the first session reached it, as `begin`; 0: none has
  std::uint64_t missed = 0;                     // events that it fired before, and no state dump has told later
  std::map<std::string, std::uint64_t> events;  // fired while a session recorded them; none that is zero

  std::uint64_t total() const {
    return std::accumulate(events.begin(), events.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& event) { return sum + event.second; });
  }
};

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
