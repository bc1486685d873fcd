// SPDX-License-Identifier: Apache-2.0
#include "base/processes/process_stat.hpp"

#include <fmt/core.h>

#include <fstream>
#include <sstream>

namespace launch {

// "pid (name) state parent … started …", and the name may have brackets in it.
ProcessStat read_process_stat(pid_t pid) {
  constexpr int kFieldsBeforeStart = 17;  // after that of the parent
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(file, line);
  const std::size_t open = line.find('(');
  const std::size_t close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 4 >= line.size()) {
    return {};
  }
  ProcessStat process{.name = line.substr(open + 1, close - open - 1)};
  std::istringstream fields(line.substr(close + 1));
  fields >> process.state >> process.parent;
  std::string field;
  for (int i = 0; i < kFieldsBeforeStart; ++i) {
    fields >> field;
  }
  fields >> process.started;
  return process;
}

}  // namespace launch
