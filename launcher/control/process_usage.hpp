// SPDX-License-Identifier: Apache-2.0
// What processes use of the machine, asked by those who want to know it: the launcher itself never does.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "base/processes/process_usage.hpp"

namespace launch {

// Reads the usage of many processes. The kernel takes microseconds for each, so other threads begin while the caller
// still adds processes. For use by one thread.
class UsageReader {
 public:
  UsageReader() = default;
  ~UsageReader();
  UsageReader(const UsageReader&) = delete;
  UsageReader& operator=(const UsageReader&) = delete;

  void add(pid_t pid);
  // Waits for all. The order is that of add(). To be called once.
  std::vector<std::optional<ProcessUsage>> take();

 private:
  void begin_threads();
  void read();

  std::mutex mutex_;
  std::condition_variable more_;
  std::vector<pid_t> pids_;
  std::vector<std::optional<ProcessUsage>> usage_;
  std::size_t begun_ = 0;  // so many of the processes are read or about to be
  bool complete_ = false;
  std::vector<std::jthread> others_;  // ends first, it uses the other members
};

// Adds `cpu` (seconds) and `memory` (bytes) to those processes of an answer to "ps" that run. One that is stopped by a
// signal gets the state "stopped".
void add_usage(nlohmann::ordered_json& processes);

}  // namespace launch
