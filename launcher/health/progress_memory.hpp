// SPDX-License-Identifier: Apache-2.0
// The memory in which executors tell of their progress: a page for each process that is watched for it.
//
// It is a file without a name. Processes open it by way of the launcher, /proc/PID/fd/N, so nothing is left of it,
// however the launch ends.
#pragma once

#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "executor_progress/progress_page.hpp"

namespace launch {

class ProgressMemory {
 public:
  ProgressMemory() = default;
  ~ProgressMemory();
  ProgressMemory(const ProgressMemory&) = delete;
  ProgressMemory& operator=(const ProgressMemory&) = delete;

  struct Place {
    executor_progress::Page* page;  // valid as long as the memory
    std::string text;               // what the variable of the process has to be
  };
  // A page of its own. Throws std::system_error.
  Place add();

 private:
  UniqueFd file_;
  std::vector<executor_progress::Page*> pages_;
};

// Gives all slots back: the processes that had them have ended.
void clear(executor_progress::Page& page);

}  // namespace launch
