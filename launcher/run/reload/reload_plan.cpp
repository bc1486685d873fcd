// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/reload/reload_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace launch {
namespace {

constexpr std::size_t kShown = 3;     // single changes of a group
constexpr std::size_t kLongest = 60;  // bytes of a value that is shown

std::string shortened(const std::string& text) {
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

std::string joined(std::vector<std::string> changes) {
  if (changes.size() > kShown) {
    const std::size_t more = changes.size() - kShown;
    changes.resize(kShown);
    changes.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{}", fmt::join(changes, ", "));
}

// "rate:=10 -> rate:=20"; empty if there are more or fewer words now.
std::string changed_words(const ProcessSpec& now, const ProcessSpec& fresh) {
  if (now.argv.size() != fresh.argv.size()) {
    return fmt::format("{} -> {}", shortened(fmt::format("{}", fmt::join(now.argv, " "))),
                       shortened(fmt::format("{}", fmt::join(fresh.argv, " "))));
  }
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < now.argv.size(); ++i) {
    if (!fresh.argv[i].empty() && now.argv[i] != fresh.argv[i]) {
      changes.push_back(fmt::format("{} -> {}", shortened(now.argv[i]), shortened(fresh.argv[i])));
    }
  }
  return changes.empty() && now.shell != fresh.shell ? std::string("shell") : joined(std::move(changes));
}

// The launcher adds some of its own to the environment of a process that it starts.
bool is_of_launcher(const std::string& name) {
  return name == "LD_PRELOAD" || name.starts_with("LAUNCH_") || name.starts_with("LTTNG_");
}

std::string changed_variables(const Environment& now, const Environment& fresh) {
  std::vector<std::string> changes;
  for (const auto& [name, value] : now) {
    const auto found = fresh.find(name);
    if (is_of_launcher(name)) {
      continue;
    }
    if (found == fresh.end()) {
      changes.push_back(name + " gone");
    } else if (found->second != value) {
      changes.push_back(fmt::format("{} {} -> {}", name, shortened(value), shortened(found->second)));
    }
  }
  for (const auto& [name, value] : fresh) {
    if (!now.contains(name)) {
      changes.push_back(fmt::format("{} new, {}", name, shortened(value)));
    }
  }
  return joined(std::move(changes));
}

std::string directory_text(const std::string& directory) {
  return directory.empty() ? "that of the launch" : directory;
}

std::string detail(DeclaredProcess::Group group, const ProcessSpec& now, const ProcessSpec& fresh) {
  switch (group) {
    case DeclaredProcess::kCommandLine:
      return changed_words(now, fresh);
    case DeclaredProcess::kEnvironment:
      return changed_variables(now.environment, fresh.environment);
    case DeclaredProcess::kDirectory:
      return fmt::format("{} -> {}", directory_text(now.working_directory), directory_text(fresh.working_directory));
    default:
      return "";
  }
}

std::vector<std::string> changed_groups(const DeclaredProcess& before, const DeclaredProcess& now,
                                        const ProcessSpec* running, const ProcessSpec& fresh) {
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < DeclaredProcess::kGroups; ++i) {
    if (before.groups[i] == now.groups[i]) {
      continue;
    }
    const auto group = static_cast<DeclaredProcess::Group>(i);
    const std::string text = running == nullptr ? "" : detail(group, *running, fresh);
    changes.push_back(text.empty() ? std::string(name_of(group)) : fmt::format("{}: {}", name_of(group), text));
  }
  return changes;
}

// What is known of the processes that wait: which of them can go on waiting.
class Planner {
 public:
  Planner(const std::vector<KnownProcess>& before, const Requests& requests, const ReloadView& view)
      : before_(before), requests_(requests), view_(view) {
    view.processes.for_each([this](const TrackedProcess& process, const ProcessSpec* waiting) {
      if (waiting != nullptr) {
        waiting_.insert(&process);
      }
    });
  }

  ReloadPlan plan() {
    ReloadPlan plan;
    plan.declared = declared_processes(requests_);
    std::vector<DeclaredProcess> old;
    old.reserve(before_.size());
    for (const KnownProcess& known : before_) {
      old.push_back(known.declared);
    }
    const auto same = find_same(old, plan.declared);
    std::vector<bool> is_found(before_.size(), false);
    for (std::size_t i = 0; i < same.size(); ++i) {
      if (same[i]) {
        is_found[*same[i]] = true;
      }
      plan.processes.push_back(same[i] ? compare(before_[*same[i]], plan.declared[i], requests_.processes[i])
                                       : PlannedProcess{.label = requests_.processes[i].name});
    }
    for (std::size_t i = 0; i < before_.size(); ++i) {
      if (!is_found[i]) {
        plan.gone.push_back(before_[i].process);
        plan.gone_labels.push_back(label_of(*before_[i].process));
      }
    }
    wait_again(plan);
    return plan;
  }

 private:
  std::string label_of(const TrackedProcess& process) const {
    return process.id == 0 ? process.names.front() : view_.supervisor.view(process.id).label;
  }

  PlannedProcess compare(const KnownProcess& known, const DeclaredProcess& now, const ProcessSpec& fresh) const {
    const DeclaredProcess& before = known.declared;
    TrackedProcess& process = *known.process;
    PlannedProcess planned{.fate = Fate::kStays, .process = &process, .label = label_of(process)};
    const ProcessSpec* const running = process.id == 0 ? nullptr : &view_.supervisor.view(process.id).spec;
    planned.changes = changed_groups(before, now, running, fresh);
    const bool only_parameters = planned.changes.empty() && before.command_words != now.command_words;
    if (only_parameters) {
      planned.changes = parameter_changes(before, now);
    }
    if (process.id == 0) {
      const bool is_same = before.starts_as(now) && before.dependencies == now.dependencies &&
                           before.policy == now.policy && fresh.python_action.empty();
      if (!is_same) {
        planned.fate = Fate::kStarts;
      }
      return planned;
    }
    planned.needs_new_spec = !before.starts_as(now);
    if (planned.changes.empty()) {
      if (before.policy != now.policy) {
        planned.fate = Fate::kTakesOver;
        planned.changes = {"respawn, timeouts or exits"};
      }
    } else if (view_.was_stopped(process.id)) {
      planned.fate = Fate::kTakesOver;
    } else {
      planned.fate = Fate::kRestarts;
      if (only_parameters && view_.may_set && !now.node.empty() && view_.supervisor.view(process.id).pid >= 0) {
        if (auto parameters = changed_parameters(before, now)) {
          planned.fate = Fate::kSets;
          planned.parameters = *std::move(parameters);
        }
      }
    }
    return planned;
  }

  // One that waits for a process that is gone, or that begins to wait anew, has to begin anew, too.
  void wait_again(ReloadPlan& plan) const {
    std::set<const TrackedProcess*> moved(plan.gone.begin(), plan.gone.end());
    for (const PlannedProcess& planned : plan.processes) {
      if (planned.fate == Fate::kStarts && planned.process != nullptr) {
        moved.insert(planned.process);
      }
    }
    for (bool again = true; again;) {
      again = false;
      for (PlannedProcess& planned : plan.processes) {
        if (planned.fate != Fate::kStays || !waiting_.contains(planned.process)) {
          continue;
        }
        const auto targets = view_.processes.targets(*planned.process);
        if (std::any_of(targets.begin(), targets.end(),
                        [&](const TrackedProcess* target) { return moved.contains(target); })) {
          planned.fate = Fate::kStarts;
          moved.insert(planned.process);
          again = true;
        }
      }
    }
  }

  const std::vector<KnownProcess>& before_;
  const Requests& requests_;
  const ReloadView& view_;
  std::set<const TrackedProcess*> waiting_;
};

}  // namespace

ReloadPlan plan_reload(const std::vector<KnownProcess>& before, const Requests& requests, const ReloadView& view) {
  return Planner(before, requests, view).plan();
}

}  // namespace launch
