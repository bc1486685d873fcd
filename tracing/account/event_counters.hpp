// SPDX-License-Identifier: Apache-2.0
// How many events the processes of a launch have fired, as they say themselves while they run: the counter files of
// libtracetools (docs/tracetools.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tracing {

// What libtracetools looks for in the environment of a process.
inline constexpr const char* kEventCountersVariable = "TRACETOOLS_EVENT_COUNTERS";

struct EventCounts {
  std::int64_t pid = 0;
  std::string process;                          // the name of its program
  std::uint64_t begin = 0;                      // CLOCK_MONOTONIC, ns
  std::uint64_t end = 0;                        // 0: it runs, or was killed
  std::uint64_t cpu = 0;                        // ns of processor time until `end`
  std::map<std::string, std::uint64_t> events;  // fired while a session recorded them; none that is zero

  std::uint64_t total() const;
};

// A directory in shared memory for the files of all processes of a launch, removed with its last owner.
class EventCounterDirectory {
 public:
  // The directory of this process, which all sessions of a launch share. It is made when no session has it yet. Null
  // when there is no room.
  static std::shared_ptr<EventCounterDirectory> shared();

  explicit EventCounterDirectory(std::filesystem::path path) : path_(std::move(path)) {}
  ~EventCounterDirectory();
  EventCounterDirectory(const EventCounterDirectory&) = delete;
  EventCounterDirectory& operator=(const EventCounterDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

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

 private:
  class File;

  std::filesystem::path directory_;
  std::map<std::string, std::unique_ptr<File>> files_;  // by name
};

}  // namespace tracing
