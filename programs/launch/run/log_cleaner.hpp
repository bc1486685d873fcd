// SPDX-License-Identifier: Apache-2.0
// Removes the logs of earlier launches while a launch runs.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <thread>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "launcher/process/output/output_router.hpp"

namespace launch {

// Removes log directories of earlier launches on a thread of its own, because a full disk is slow to read.
class LogCleaner {
 public:
  // The references must outlive this object.
  LogCleaner(EventLoop& loop, const LogDirectory& own, const LogLimits& limits, OutputRouter& output) {
    // In the loop: from then on signals are blocked, so that the thread gets none.
    loop.post([this, &loop, &output, limits, own_path = own.path] {
      thread_ = std::thread([&loop, &output, limits, own_path] {
        const RemovedLogs removed =
            remove_old_logs(std::filesystem::path(own_path).parent_path().string(), own_path, limits);
        if (removed.directories > 0) {
          loop.post([&output, removed] {
            output.message(LogLevel::kInfo, "launch",
                           fmt::format("removed the logs of {} earlier launch{} ({:.1f} MiB), {} are left; --keep-logs "
                                       "says how many",
                                       removed.directories, removed.directories == 1 ? "" : "es",
                                       static_cast<double>(removed.bytes) / (1 << 20), removed.left));
          });
        }
      });
    });
  }
  ~LogCleaner() {
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  LogCleaner(const LogCleaner&) = delete;
  LogCleaner& operator=(const LogCleaner&) = delete;

 private:
  std::thread thread_;
};

}  // namespace launch
