// SPDX-License-Identifier: Apache-2.0
// The limits of the processes of a launch that a cgroup holds: makes the cgroups, and tells the user when a limit is
// near, when it slows a process, and when the kernel has ended one.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "launcher/process/control_groups/control_group_tree.hpp"
#include "launcher/process/control_groups/control_group_use.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class Guardian;

class LimitCare {
 public:
  using Tell = std::function<void(LogLevel level, const std::string& logger, const std::string& text)>;

  static constexpr Duration kInterval = std::chrono::seconds(2);
  static constexpr double kNear = 0.9;  // of memory_max

  // The loop must outlive this object.
  LimitCare(EventLoop& loop, Tell tell) : loop_(loop), tell_(std::move(tell)) {}

  // The guardian, which must outlive this object, removes the cgroups when the launcher is killed.
  void use_guardian(Guardian& guardian) { guardian_ = &guardian; }

  // To be called before the process with this number starts for the first time.
  void prepare(ProcessSpec& spec, ProcessId id);
  void on_event(const ProcessEvent& event);

  // Instead of the place that is found for this process.
  void use_place(std::function<ControlGroupPlace()> find) { find_ = std::move(find); }

 private:
  // One run of a process; or a group, of which a process has started.
  struct Run {
    std::string label;
    std::string whose;       // "it", "its group"
    ControlGroupUse before;  // at its start: the kernel counts for the cgroup
    SourceRange origin;
    bool told_near = false;
    bool told_slowed = false;
    bool told_refused = false;
  };

  ControlGroupTree& tree();
  void look();
  void look_at(const std::string& path, Run& run);

  EventLoop& loop_;
  Tell tell_;
  Guardian* guardian_ = nullptr;
  std::function<ControlGroupPlace()> find_;
  std::unique_ptr<ControlGroupTree> tree_;
  std::map<std::string, Run> runs_;  // by the path of the cgroup; a group stays to the end
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
