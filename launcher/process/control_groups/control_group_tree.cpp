// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/control_groups/control_group_tree.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// 0, or an errno. O_CREAT does nothing in a cgroup, where all files exist.
int write_to(const std::string& path, const std::string& text) {
  const UniqueFd file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  return file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : errno;
}

std::set<std::string> words_of(const std::string& path) {
  std::set<std::string> words;
  for (const std::vector<std::string>& line : words_of_lines(read_whole_file(path))) {
    words.insert(line.begin(), line.end());
  }
  return words;
}

// The controllers that are there. Those that the directories below may use, afterwards.
void enable_controllers(const std::string& path) {
  for (const char* const controller : {"memory", "cpu", "io", "pids"}) {
    static_cast<void>(write_to(path + "/cgroup.subtree_control", fmt::format("+{}", controller)));
  }
}

void move_processes(const std::string& from, const std::string& to) {
  for (const std::string& process : words_of(from + "/cgroup.procs")) {
    if (process != "0") {  // of another process namespace; here it would mean this process
      static_cast<void>(write_to(to + "/cgroup.procs", process));
    }
  }
}

// The other processes of a delegated cgroup, such as the guardians, go into one of their own. Its path; empty if there
// are none.
std::string move_processes_away(const std::string& path, const std::string& launch_id) {
  const std::string outside = fmt::format("{}/launch-{}{}", path, launch_id, kOutside);
  if (words_of(path + "/cgroup.procs").empty() || (::mkdir(outside.c_str(), 0755) != 0 && errno != EEXIST)) {
    return "";
  }
  move_processes(path, outside);
  return outside;
}

void move_processes_back(const ControlGroupPlace& place) {
  for (const char* const controller : {"memory", "cpu", "io", "pids"}) {
    static_cast<void>(write_to(place.directory + "/cgroup.subtree_control", fmt::format("-{}", controller)));
  }
  move_processes(place.outside, place.directory);
  ::rmdir(place.outside.c_str());
}

std::string file_name_of(std::string label) {
  std::replace(label.begin(), label.end(), '/', '_');
  return label;
}

// The lowest first. A cgroup with processes stays.
void remove_tree(const fs::path& path) {
  std::error_code gone;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, gone)) {
    if (entry.is_directory(gone) && !entry.is_symlink(gone)) {
      remove_tree(entry.path());
    }
  }
  ::rmdir(path.c_str());
}

}  // namespace

ControlGroupPlace ControlGroupPlace::find(const OwnCgroup& own, const std::string& launch_id, bool is_root,
                                          const std::function<bool(const std::string&)>& is_delegated) {
  if (own.path.empty()) {
    return {.obstacle = "cgroups of version 2 are not mounted"};
  }
  // The guardian has made the cgroup of the launcher there (launch_cgroup.cpp).
  const fs::path path = own.path;
  if (path.filename() == "launch-" + launch_id && is_delegated(path.parent_path().string())) {
    return {.directory = path.parent_path().string()};
  }
  if (is_root) {
    return {.directory = own.mount};
  }
  return {.obstacle =
              "the cgroup of the launch is not delegated to its user; start it by `systemd-run --user --scope -p "
              "Delegate=yes launch …`, or with Delegate=yes in its unit"};
}

ControlGroupPlace ControlGroupPlace::find(const std::string& launch_id) {
  const OwnCgroup own = own_cgroup();
  ControlGroupPlace place =
      find(own, launch_id, ::geteuid() == 0, [](const std::string& path) { return launch::is_delegated(path); });
  if (!place.directory.empty() && place.directory != own.mount) {
    place.outside = move_processes_away(place.directory, launch_id);
  }
  return place;
}

ControlGroupTree::~ControlGroupTree() {
  if (tree_.empty()) {
    return;
  }
  remove_tree(tree_);
  if (::access(tree_.c_str(), F_OK) == 0) {
    return;
  }
  if (!place_.outside.empty()) {
    move_processes_back(place_);
  }
  if (withdraw_) {
    withdraw_();
  }
}

bool ControlGroupTree::make_tree() {
  if (std::exchange(has_tried_, true)) {
    return !tree_.empty();
  }
  place_ = find_();
  if (!place_.obstacle.empty()) {
    warn_(fmt::format("limits of memory, processors and processes that a cgroup holds have no effect: {}",
                      place_.obstacle));
    return false;
  }
  const std::string path = fmt::format("{}/launch-{}{}", place_.directory, launch_id_, kLimited);
  if (announce_) {
    withdraw_ = announce_(path, place_);
  }
  enable_controllers(place_.directory);
  if (::mkdir(path.c_str(), 0755) != 0 && errno != EEXIST) {
    warn_(
        fmt::format("limits of memory, processors and processes that a cgroup holds have no effect: cannot make '{}': "
                    "{}",
                    path, ::strerror(errno)));
    return false;
  }
  tree_ = path;
  controllers_ = words_of(tree_ + "/cgroup.controllers");
  enable_controllers(tree_);
  return true;
}

void ControlGroupTree::note_missing(const std::string& attribute, const std::string& why) {
  if (told_.insert(attribute).second) {
    warn_(fmt::format("{} has no effect: {}", attribute, why));
  }
}

bool ControlGroupTree::make_group(const std::string& path, const ControlGroupLimits& limits) {
  if (::mkdir(path.c_str(), 0755) != 0 && errno != EEXIST) {
    note_missing(fmt::format("the cgroup '{}'", path), ::strerror(errno));
    return false;
  }
  for (const ControlGroupSetting& setting : settings_of(limits)) {
    if (!controllers_.contains(setting.controller)) {
      note_missing(setting.attribute,
                   fmt::format("the controller '{}' is not in '{}/cgroup.controllers'; it may belong "
                               "to cgroups of version 1",
                               setting.controller, tree_));
    } else if (const int error = write_to(path + "/" + setting.file, setting.value); error != 0) {
      note_missing(setting.attribute,
                   fmt::format("cannot write {} to '{}/{}': {}", setting.value, path, setting.file, ::strerror(error)));
    }
  }
  return true;
}

std::string ControlGroupTree::make(const std::string& label, const ControlGroupLimits& limits,
                                   const std::vector<std::shared_ptr<const ControlGroup>>& groups) {
  if ((!limits.any() && groups.empty()) || !make_tree()) {
    return "";
  }
  std::string path = tree_;
  for (const std::shared_ptr<const ControlGroup>& group : groups) {
    const auto [found, is_new] = groups_.emplace(group, "");
    if (is_new) {
      found->second = fmt::format("{}/group.{}", path, groups_.size());
      if (!make_group(found->second, group->limits)) {
        return "";
      }
      enable_controllers(found->second);
    }
    path = found->second;
  }
  path += "/" + file_name_of(label);
  return make_group(path, limits) ? path : "";
}

}  // namespace launch
