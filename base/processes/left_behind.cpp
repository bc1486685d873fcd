// SPDX-License-Identifier: Apache-2.0
#include "base/processes/left_behind.hpp"

#include <sstream>
#include <string_view>

namespace launch {

std::vector<std::string> left_behind(const std::string& screen) {
  std::vector<std::string> messages;
  std::istringstream lines(screen);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string_view begin : {"[WARNING] [launch]: ", "[ERROR] [launch]: "}) {
      if (!line.starts_with(begin)) {
        continue;
      }
      line.erase(0, begin.size());
      for (const std::string_view end : {"; ending it", "; ending them"}) {
        if (line.ends_with(end) && line.find(" running: ") != std::string::npos) {
          messages.push_back(line.substr(0, line.size() - end.size()));
        }
      }
      if (line.starts_with("cannot end ")) {
        messages.push_back(line);
      }
      break;
    }
  }
  return messages;
}

}  // namespace launch
