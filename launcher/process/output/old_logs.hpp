// SPDX-License-Identifier: Apache-2.0
// Removes the log directories of earlier launches, so that the disk does not fill up.
//
// Only what a launch has made is removed: a directory with its mark, in which there is nothing but logs, and whose
// launch does not run any more. What ros2 launch has made has no mark.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/files/unique_fd.hpp"

namespace launch {

// How much is kept; 0: no limit.
struct LogLimits {
  std::size_t runs = 200;
  std::chrono::days age{90};
  std::uint64_t bytes = std::uint64_t{4} << 30;
};

// "200,90d,4G": directories, days, bytes; one or several of them, the others have no limit. "all" keeps everything.
// Throws std::invalid_argument with a sentence.
LogLimits parse_log_limits(std::string_view text);

// Marks the directory of a launch that runs, as long as the descriptor is open. An invalid one if the directory can't
// be marked; it is never removed then.
UniqueFd mark_log_directory(const std::string& directory);

struct RemovedLogs {
  std::size_t directories = 0;
  std::uint64_t bytes = 0;
  std::size_t left = 0;  // directories of launches, without those that run
};

// Removes the oldest ones below `base` until the limits hold. `own` is the directory of this launch. A directory that
// was written less than a minute ago stays. Does not throw.
RemovedLogs remove_old_logs(const std::string& base, const std::string& own, const LogLimits& limits);

}  // namespace launch
