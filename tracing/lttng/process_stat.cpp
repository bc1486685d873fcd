// SPDX-License-Identifier: Apache-2.0
#include "tracing/lttng/process_stat.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <fstream>

namespace tracing {

// "pid (name) state parent …", and the name may have brackets in it.
ProcessStat read_process_stat(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  std::getline(file, line);
  const std::size_t open = line.find('(');
  const std::size_t close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 4 >= line.size()) return {};
  return {.name = line.substr(open + 1, close - open - 1),
          .state = line[close + 2],
          .parent = std::atoi(line.c_str() + close + 4)};
}

}  // namespace tracing
