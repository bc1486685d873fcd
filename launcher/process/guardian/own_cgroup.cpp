// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/own_cgroup.hpp"

#include <sys/xattr.h>
#include <unistd.h>

#include <cstddef>
#include <string_view>
#include <utility>

#include "launcher/process/guardian/process_scan.hpp"

namespace launch {

std::vector<std::vector<std::string>> words_of_lines(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1);
  std::string word;
  for (const char byte : text) {
    if (byte != ' ' && byte != '\n') {
      word += byte;
      continue;
    }
    lines.back().push_back(std::exchange(word, {}));
    if (byte == '\n') {
      lines.emplace_back();
    }
  }
  return lines;
}

OwnCgroup own_cgroup() {
  return own_cgroup(read_proc_file(::getpid(), "cgroup"), read_proc_file(::getpid(), "mountinfo"));
}

// proc(5): "36 35 0:31 ROOT POINT options … - cgroup2 …".
OwnCgroup own_cgroup(const std::string& cgroup, const std::string& mountinfo) {
  std::string name;
  for (const std::vector<std::string>& line : words_of_lines(cgroup)) {
    if (!line.empty() && line[0].starts_with("0::")) {
      name = line[0].substr(3);
    }
  }
  if (name.empty()) {
    return {};
  }
  for (const std::vector<std::string>& line : words_of_lines(mountinfo)) {
    for (std::size_t i = 5; i + 1 < line.size(); ++i) {
      if (line[i] == "-" && line[i + 1] == "cgroup2") {
        const std::string root = line[3] == "/" ? "" : line[3];
        if (name.starts_with(root)) {
          const std::string below = name.substr(root.size());
          return {line[4] + (below == "/" ? "" : below), line[4]};
        }
      }
    }
  }
  return {};
}

bool is_delegated(const std::string& path) {
  for (const char* const mark : {"user.delegate", "trusted.delegate"}) {
    char value = 0;
    if (::getxattr(path.c_str(), mark, &value, 1) == 1 && value == '1') {
      return true;
    }
  }
  return false;
}

}  // namespace launch
