// SPDX-License-Identifier: Apache-2.0
#include "base/processes/python_at_work.hpp"

#include <cstdlib>

namespace launch {

std::uint32_t line_in_python_traces(const std::string& traces, const std::string& file) {
  const std::size_t last = traces.rfind("(most recent call first)");
  const std::string frame = file.empty() ? "  File \"" : "  File \"" + file + "\", line ";
  const std::size_t found = last == std::string::npos ? last : traces.find(frame, last);
  const std::size_t number = found == std::string::npos ? found : traces.find(", line ", found);
  return number == std::string::npos
             ? 0
             : static_cast<std::uint32_t>(std::strtoul(traces.c_str() + number + 7, nullptr, 10));
}

std::string file_in_python_traces(const std::string& traces) {
  const std::size_t last = traces.rfind("(most recent call first)");
  const std::size_t found = last == std::string::npos ? last : traces.find("  File \"", last);
  if (found == std::string::npos) {
    return {};
  }
  const std::size_t begin = found + 8;
  return traces.substr(begin, traces.find("\", line ", begin) - begin);
}

}  // namespace launch
