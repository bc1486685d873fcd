// SPDX-License-Identifier: Apache-2.0
// Removes the logs of earlier launches while a launch runs.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <thread>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "launcher/process/output/output_router.hpp"

namespace launch {

// Removes log directories of earlier launches on a thread of its own, because a full disk is slow to read.
class LogCleaner {
 public:
  // The references must outlive this object.
  LogCleaner(EventLoop& loop, const LogDirectory& own, const LogLimits& limits, OutputRouter& output)
      : output_(output) {
    // In the loop: from then on signals are blocked, so that the thread gets none.
    loop.post([this, &loop, limits, path = own.path] {
      try {
        thread_ = std::thread([this, &loop, limits, path] {
          removed_ = remove_old_logs(std::filesystem::path(path).parent_path().string(), path, limits);
          loop.post([this] { tell(); });
        });
      } catch (const std::system_error&) {
        // Without a thread the old logs stay for a later launch.
      }
    });
  }
  ~LogCleaner() { tell(); }
  LogCleaner(const LogCleaner&) = delete;
  LogCleaner& operator=(const LogCleaner&) = delete;

 private:
  // Once, when the thread is done.
  void tell() {
    if (!thread_.joinable()) {
      return;
    }
    thread_.join();
    if (removed_.directories > 0) {
      output_.message(
          LogLevel::kInfo, "launch",
          fmt::format("removed the logs of {} earlier launch{} ({:.1f} MiB), {} are left; --keep-logs says how many",
                      removed_.directories, removed_.directories == 1 ? "" : "es",
                      static_cast<double>(removed_.bytes) / (1 << 20), removed_.left));
    }
  }

  OutputRouter& output_;
  RemovedLogs removed_;
  std::thread thread_;
};

}  // namespace launch
