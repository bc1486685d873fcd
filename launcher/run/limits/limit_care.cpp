// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/limits/limit_care.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <utility>
#include <variant>

#include "base/processes/process_mark.hpp"
#include "launcher/process/guardian/guardian.hpp"

namespace launch {
namespace {

// Of a launcher that was killed: ends what is left of processes, at once and whatever they start meanwhile, where the
// kernel can (cgroup.kill, Linux 5.14), and removes the cgroups, which the kernel allows when their processes are gone:
// that is tried for eight seconds, on a busy machine. Groups are named with a dot, processes with a dash.
// Then the processes outside of the launch go back to the delegated cgroup. The words: the tree, that cgroup, the one
// outside.
constexpr const char* kCleanUp =
    R"(find "$0" -mindepth 1 -type d -name '*-[0-9]*' ! -path '*.leave*' -exec sh -c 'echo 1 >"$0/cgroup.kill"' {} \; 2>/dev/null
for i in $(seq 80); do
  find "$0" -depth -type d -exec rmdir {} + 2>/dev/null
  test ! -d "$0" || { sleep 0.1; continue; }
  test -d "$2" || exit 0
  for controller in memory cpu io pids; do echo -$controller >"$1/cgroup.subtree_control"; done 2>/dev/null
  while read process; do echo $process >"$1/cgroup.procs"; done <"$2/cgroup.procs"
  rmdir "$2"
  exit
done)";
// What it leaves running goes on after the launch.
constexpr const char* kLeftRunning = ".leave";

std::string mebibytes(std::uint64_t bytes) {
  constexpr double kBytes = 1024.0 * 1024.0;
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / kBytes);
}

}  // namespace

ControlGroupTree& LimitCare::tree() {
  if (tree_) {
    return *tree_;
  }
  const std::string id = guardian_ != nullptr ? guardian_->id() : std::to_string(::getpid());
  tree_ = std::make_unique<ControlGroupTree>(
      find_ ? find_ : [id] { return ControlGroupPlace::find(id); }, id,
      [this](const std::string& text) { tell_(LogLevel::kWarning, "launch", text); });
  if (guardian_ != nullptr) {
    tree_->announce_to(
        [guardian = guardian_](const std::string& path, const ControlGroupPlace& place) -> std::function<void()> {
          const std::int32_t number = guardian->add_clean_up(
              {"/bin/sh", "-c", kCleanUp, path, place.directory, place.outside.empty() ? "-" : place.outside});
          return [guardian, number] { guardian->remove_clean_up(number); };
        });
  }
  return *tree_;
}

void LimitCare::prepare(ProcessSpec& spec, ProcessId id) {
  if (spec.control_limits.any() || !spec.control_groups.empty()) {
    spec.limits.control_group = tree().make(
        fmt::format("{}-{}{}", spec.name, id, spec.environment.contains(kLeaveRunningVariable) ? kLeftRunning : ""),
        spec.control_limits, spec.control_groups);
  }
}

void LimitCare::on_event(const ProcessEvent& event) {
  const std::string& path = event.spec.limits.control_group;
  if (path.empty()) {
    return;
  }
  if (std::holds_alternative<ProcessStarted>(event.what)) {
    runs_.insert_or_assign(path, Run{event.label, "it", read_control_group(path), event.spec.origin});
    std::filesystem::path around = path;
    for (auto group = event.spec.control_groups.rbegin(); group != event.spec.control_groups.rend(); ++group) {
      around = around.parent_path();
      if ((*group)->limits.any() && !runs_.contains(around.string())) {
        runs_.emplace(around.string(),
                      Run{event.label, "its group", read_control_group(around.string()), (*group)->where});
      }
    }
    if (!timer_) {
      timer_ = loop_.after(kInterval, [this] { look(); });
    }
  } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    const ControlGroupUse use = read_control_group(path);
    if (exited->exit.out_of_memory) {
      tell_(LogLevel::kError, event.label,
            use.memory_max
                ? fmt::format("the kernel has ended it, because it had used up its memory_max of {} ({})",
                              mebibytes(*use.memory_max), to_string(event.spec.origin))
                : fmt::format("the kernel has ended it for want of memory ({})", to_string(event.spec.origin)));
    }
    runs_.erase(path);
  }
}

void LimitCare::look() {
  for (auto& [path, run] : runs_) {
    look_at(path, run);
  }
  timer_.reset();
  if (!runs_.empty()) {
    timer_ = loop_.after(kInterval, [this] { look(); });
  }
}

// Reads a file or two, not more: there may be a thousand processes.
void LimitCare::look_at(const std::string& path, Run& run) {
  const auto warn = [&](const std::string& text) {
    tell_(LogLevel::kWarning, run.label, fmt::format("{} ({})", text, to_string(run.origin)));
  };
  const ControlGroupUse& limits = run.before;
  const std::uint64_t memory = limits.memory_max || limits.memory_high ? read_number(path + "/memory.current") : 0;
  const auto is_near = [&](const std::optional<std::uint64_t>& limit) {
    return limit && static_cast<double>(memory) >= kNear * static_cast<double>(*limit);
  };
  if (is_near(limits.memory_max) && !std::exchange(run.told_near, true)) {
    warn(
        fmt::format("{} uses {} of its memory_max of {}", run.whose, mebibytes(memory), mebibytes(*limits.memory_max)));
  }
  if (!run.told_slowed && is_near(limits.memory_high) && read_keyed(path + "/memory.events", "high") > limits.slowed) {
    run.told_slowed = true;
    warn(fmt::format("{} has exceeded its memory_high of {}: the kernel slows it", run.whose,
                     mebibytes(*limits.memory_high)));
  }
  if (!run.told_refused && limits.pids_max && read_keyed(path + "/pids.events", "max") > limits.refused) {
    run.told_refused = true;
    warn(fmt::format("{} has reached its pids_max of {}: the kernel has refused it a process or a thread", run.whose,
                     *limits.pids_max));
  }
}

}  // namespace launch
