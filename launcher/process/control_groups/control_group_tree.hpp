// SPDX-License-Identifier: Apache-2.0
// The cgroups of a launch, with the limits of its processes: one for each process that has limits, or is in a <group>
// that has some, below that of the group.
//
//   DELEGATED/launch-ID-limits/group.1/talker-1
//
// They are made where the user may divide a cgroup of version 2: in the one that systemd has delegated to the launch,
// or, for root, directly below the root of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "launcher/process/control_groups/control_group.hpp"
#include "launcher/process/guardian/own_cgroup.hpp"

namespace launch {

// Where cgroups can be made, or why not.
struct ControlGroupPlace {
  std::string directory{};  // below it
  std::string outside{};    // the cgroup into which its other processes were moved; empty: none
  std::string obstacle{};   // "cgroups of version 2 are not mounted"; empty: there is none

  // For this process. It may move the processes of its delegated cgroup into another one below, because a cgroup with
  // processes can't be divided. `launch_id` is that of the guardian.
  static ControlGroupPlace find(const std::string& launch_id);
  // The decision alone.
  static ControlGroupPlace find(const OwnCgroup& own, const std::string& launch_id, bool is_root,
                                const std::function<bool(const std::string&)>& is_delegated);
};

class ControlGroupTree {
 public:
  // `warn` gets one word about all that can't be limited. `announce` is called with the path before the tree is made;
  // what it returns is called when the tree has been removed.
  ControlGroupTree(std::function<ControlGroupPlace()> find, std::string launch_id,
                   std::function<void(const std::string&)> warn)
      : find_(std::move(find)), launch_id_(std::move(launch_id)), warn_(std::move(warn)) {}
  // Removes the tree, but for cgroups in which processes are left: the guardian ends those, and removes the rest.
  ~ControlGroupTree();
  ControlGroupTree(const ControlGroupTree&) = delete;
  ControlGroupTree& operator=(const ControlGroupTree&) = delete;

  using Announce = std::function<std::function<void()>(const std::string& path, const ControlGroupPlace& place)>;
  void announce_to(Announce announce) { announce_ = std::move(announce); }

  // Makes the cgroup of a process and those of its groups, as far as they don't exist. Returns its path; empty if the
  // process has no limits, or none can be applied.
  std::string make(const std::string& label, const ControlGroupLimits& limits,
                   const std::vector<std::shared_ptr<const ControlGroup>>& groups);

 private:
  bool make_tree();
  bool make_group(const std::string& path, const ControlGroupLimits& limits);
  void note_missing(const std::string& attribute, const std::string& why);

  std::function<ControlGroupPlace()> find_;
  std::string launch_id_;
  std::function<void(const std::string&)> warn_;
  Announce announce_;
  std::function<void()> withdraw_;

  bool has_tried_ = false;
  ControlGroupPlace place_;
  std::string tree_;  // empty: there is none
  std::set<std::string> controllers_;
  std::map<std::shared_ptr<const ControlGroup>, std::string> groups_;
  std::set<std::string> told_;
};

}  // namespace launch
