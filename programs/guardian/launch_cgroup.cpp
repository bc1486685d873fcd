// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/launch_cgroup.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/own_cgroup.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

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
  const std::string own = own_cgroup().path;
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
  std::string own = own_cgroup().path;
  // The launcher may have moved this process (control_group_tree.cpp).
  if (const std::string moved = "/launch-" + launch_id + kOutside; own.ends_with(moved)) {
    own.resize(own.size() - moved.size());
  }
  LaunchCgroup cgroup(own + "/launch-" + launch_id);
  return own.empty() || ::access(cgroup.path_.c_str(), F_OK) != 0 ? LaunchCgroup() : cgroup;
}

std::vector<std::string> LaunchCgroup::trees() const {
  return exists() ? std::vector<std::string>{path_, path_ + kLimited} : std::vector<std::string>();
}

std::set<pid_t> LaunchCgroup::members() const {
  std::set<pid_t> found;
  for (const std::string& tree : trees()) {
    for_each_cgroup(tree, [&found](const std::string& path) {
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
  for (const std::string& tree : trees()) {
    write_file(tree + "/cgroup.kill", "1");
  }
}

void LaunchCgroup::remove() const {
  for (const std::string& tree : trees()) {
    for_each_cgroup(tree, [](const std::string& path) { ::rmdir(path.c_str()); });
  }
}

}  // namespace launch
