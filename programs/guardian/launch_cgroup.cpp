// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/launch_cgroup.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

// The lines of a text, each cut into words.
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

bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

// The directory of the cgroup of version 2 that this process is in; "" when there is none, or when it is not mounted.
// /proc/self/mountinfo, proc(5): "36 35 0:31 ROOT POINT options … - cgroup2 …".
std::string own_cgroup() {
  std::string name;
  for (const std::vector<std::string>& line : words_of_lines(read_proc_file(::getpid(), "cgroup"))) {
    if (!line.empty() && begins_with(line[0], "0::")) {
      name = line[0].substr(3);
    }
  }
  if (name.empty()) {
    return "";
  }
  for (const std::vector<std::string>& line : words_of_lines(read_proc_file(::getpid(), "mountinfo"))) {
    for (std::size_t i = 5; i + 1 < line.size(); ++i) {
      if (line[i] == "-" && line[i + 1] == "cgroup2") {
        const std::string root = line[3] == "/" ? "" : line[3];
        if (begins_with(name, root)) {
          return line[4] + name.substr(root.size());
        }
      }
    }
  }
  return "";
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

bool write_file(const std::string& path, const std::string& text) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  return file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

// Calls `visit` for the cgroup and for those below it, the lowest first.
template <typename Visit>
void for_each_cgroup(const std::string& path, const Visit& visit) {
  if (DIR* const directory = ::opendir(path.c_str())) {
    while (const dirent* const entry = ::readdir(directory)) {
      const std::string_view name = entry->d_name;
      if (entry->d_type == DT_DIR && name != "." && name != "..") {
        for_each_cgroup(path + "/" + entry->d_name, visit);
      }
    }
    ::closedir(directory);
  }
  visit(path);
}

}  // namespace

LaunchCgroup LaunchCgroup::make(const std::string& launch_id, pid_t launcher) {
  const std::string own = own_cgroup();
  if (own.empty() || !is_delegated(own)) {
    return {};
  }
  LaunchCgroup cgroup(own + "/launch-" + launch_id);
  if (::mkdir(cgroup.path_.c_str(), 0755) != 0) {
    return {};
  }
  if (!write_file(cgroup.path_ + "/cgroup.procs", std::to_string(launcher))) {
    cgroup.remove();
    return {};
  }
  return cgroup;
}

LaunchCgroup LaunchCgroup::find(const std::string& launch_id) {
  const std::string own = own_cgroup();
  LaunchCgroup cgroup(own + "/launch-" + launch_id);
  return own.empty() || ::access(cgroup.path_.c_str(), F_OK) != 0 ? LaunchCgroup() : cgroup;
}

std::set<pid_t> LaunchCgroup::members() const {
  std::set<pid_t> found;
  if (exists()) {
    for_each_cgroup(path_, [&found](const std::string& path) {
      for (const std::vector<std::string>& line : words_of_lines(read_whole_file(path + "/cgroup.procs"))) {
        if (!line.empty()) {
          found.insert(static_cast<pid_t>(std::strtol(line[0].c_str(), nullptr, 10)));
        }
      }
    });
  }
  return found;
}

void LaunchCgroup::kill() const {
  if (exists()) {
    write_file(path_ + "/cgroup.kill", "1");
  }
}

void LaunchCgroup::remove() const {
  if (exists()) {
    for_each_cgroup(path_, [](const std::string& path) { ::rmdir(path.c_str()); });
  }
}

}  // namespace launch
