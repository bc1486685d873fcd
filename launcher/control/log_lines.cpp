// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/log_lines.hpp"

#include <fstream>
#include <string_view>

namespace launch {
namespace {

// "1700000000.1234567 [talker-1] text" gives "[talker-1] text" if the line is one of a process that was asked for. The
// launcher's own lines have a level first: "1700000000.1234567 [INFO] [talker-1]: text".
std::string_view line_of(std::string_view stamped, const std::set<std::string, std::less<>>& names) {
  const std::size_t stamp = stamped.find(' ');
  if (stamp == std::string_view::npos || !stamped.substr(stamp + 1).starts_with('[')) {
    return {};
  }
  const std::string_view line = stamped.substr(stamp + 1);
  const std::size_t end = line.find(']');
  return end != std::string_view::npos && names.find(line.substr(1, end - 1)) != names.end() ? line
                                                                                             : std::string_view();
}

}  // namespace

std::deque<std::string> past_lines(const std::string& log, LogRange range,
                                   const std::set<std::string, std::less<>>& names, std::size_t most) {
  std::deque<std::string> lines;
  std::ifstream file(log);
  std::size_t read = range.begin;
  std::string line;
  if (range.begin > 0 && file.seekg(static_cast<std::streamoff>(range.begin - 1)) && std::getline(file, line)) {
    read += line.size();
  }
  for (; read < range.end && std::getline(file, line); read += line.size() + 1) {
    if (const std::string_view text = line_of(line, names); !text.empty()) {
      lines.emplace_back(text);
      if (lines.size() > most) {
        lines.pop_front();
      }
    }
  }
  return lines;
}

}  // namespace launch
