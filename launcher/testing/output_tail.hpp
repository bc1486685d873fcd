// SPDX-License-Identifier: Apache-2.0
// The last lines of each process of a test, which a failure shows.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/testing/failure.hpp"

namespace launch {

class OutputTail {
 public:
  static constexpr std::size_t kLines = 8;           // of a process
  static constexpr std::size_t kLineLength = 200;    // bytes of a line that are kept
  static constexpr std::size_t kShownProcesses = 3;  // when no process is named

  void add(const std::string& label, std::string_view line);

  // Puts the last lines of these processes into the failure. Without labels, the processes that have written last.
  void show(Failure& failure, const std::vector<std::string>& labels = {}) const;

 private:
  struct Lines {
    std::deque<std::string> last;
    std::size_t count = 0;
    std::size_t time = 0;  // of the last line, in lines of all processes
  };

  std::map<std::string, Lines> processes_;
  std::size_t count_ = 0;
};

}  // namespace launch
