// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/critical_start.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace tracing {

namespace {

// The process that a condition names: "talker" for "'talker' has started"; empty for a condition of the ROS graph.
std::string_view process_in(std::string_view condition) {
  if (!condition.starts_with('\'')) {
    return "";
  }
  const std::size_t end = condition.find('\'', 1);
  return end == std::string_view::npos ? "" : condition.substr(1, end - 1);
}

std::optional<std::int64_t> ready_ns(const StartedProcess& process) {
  if (!process.start.ready_after_ns) {
    return std::nullopt;
  }
  return process.start.exec_ns + *process.start.ready_after_ns;
}

// Goes back from the end to the begin of the launch. Each step ends where the one after it begins.
class PathBack {
 public:
  PathBack(const std::vector<StartedProcess>& processes, const std::vector<StartCondition>& conditions,
           const std::vector<LauncherStep>& steps, std::int64_t end_ns)
      : processes_(processes), conditions_(conditions), steps_(steps), now_(end_ns) {}

  std::vector<StartStep> from(const StartedProcess& last) {
    through_process(last, "");
    std::reverse(path_.begin(), path_.end());
    return std::move(path_);
  }

 private:
  // A step from `begin_ns` to the begin of the step after it.
  void add(const std::string& process, const std::string& what, std::int64_t begin_ns) {
    if (begin_ns >= now_) {
      return;
    }
    path_.push_back({process, what, begin_ns, now_});
    now_ = begin_ns;
  }

  // `until`: what of the process the step after it waited for; empty: that it was ready.
  void through_process(const StartedProcess& process, const std::string& until) {
    visited_.push_back(&process);
    const StartResult& start = process.start;
    // What it reached, from the last to the first. The phase in which now_ lies is called after what was waited for.
    const std::pair<std::optional<std::int64_t>, const char*> reached[] = {{start.ready_after_ns, "ready"},
                                                                           {start.node_after_ns, "its first node"},
                                                                           {start.init_after_ns, "rcl_init"},
                                                                           {0, ""}};
    std::string next = until;
    for (const auto& [after_ns, what] : reached) {
      if (!after_ns) {
        continue;
      }
      if (start.exec_ns + *after_ns < now_) {
        add(start.process, "until " + next, start.exec_ns + *after_ns);
        next = what;
      } else if (until.empty()) {
        next = what;
      }
    }
    if (start.spawn_ns) {
      add(start.process, "started by the launcher", *start.spawn_ns);
    }
    through_condition(process);
  }

  void through_condition(const StartedProcess& process) {
    const StartCondition* last = nullptr;
    for (const StartCondition& condition : conditions_) {
      if (condition.process != process.name || condition.held_ns > now_) {
        continue;
      }
      if (last == nullptr || condition.held_ns >= last->held_ns) {
        last = &condition;
      }
    }
    if (last == nullptr) {
      through_launcher();
      return;
    }
    add("", "until " + process.start.process + " was started", last->held_ns);
    const StartedProcess* const target = process_called(process_in(last->text));
    if (target != nullptr) {
      through_process(*target, last->text);
      return;
    }
    waits_for_ = last->text;
    through_launcher();
  }

  // The last process of this name that ran before now_ and is not in the path yet.
  const StartedProcess* process_called(std::string_view name) const {
    const StartedProcess* found = nullptr;
    for (const StartedProcess& process : processes_) {
      if (process.name != name || process.start.exec_ns > now_) {
        continue;
      }
      if (std::find(visited_.begin(), visited_.end(), &process) == visited_.end()) {
        found = &process;
      }
    }
    return found;
  }

  void through_launcher() {
    std::vector<const LauncherStep*> steps;
    for (const LauncherStep& step : steps_) {
      if (step.begin_ns < now_) {
        steps.push_back(&step);
      }
    }
    std::stable_sort(steps.begin(), steps.end(),
                     [](const LauncherStep* a, const LauncherStep* b) { return a->end_ns > b->end_ns; });
    for (const LauncherStep* step : steps) {
      if (step->begin_ns >= now_) {
        continue;  // within a step that is there already
      }
      add("", waits_for_.empty() ? "other things" : "until " + waits_for_, step->end_ns);
      waits_for_.clear();
      add("", step->what, step->begin_ns);
    }
  }

  const std::vector<StartedProcess>& processes_;
  const std::vector<StartCondition>& conditions_;
  const std::vector<LauncherStep>& steps_;
  std::int64_t now_ = 0;
  std::vector<StartStep> path_;  // from the last to the first
  std::vector<const StartedProcess*> visited_;
  std::string waits_for_;  // a condition of the ROS graph that the step before now_ waited for
};

}  // namespace

std::optional<StartupResult> critical_start(const std::vector<StartedProcess>& processes,
                                            const std::vector<StartCondition>& conditions,
                                            const std::vector<LauncherStep>& steps) {
  const StartedProcess* last = nullptr;
  for (const StartedProcess& process : processes) {
    if (ready_ns(process) && (last == nullptr || *ready_ns(process) > *ready_ns(*last))) {
      last = &process;
    }
  }
  if (last == nullptr) {
    return std::nullopt;
  }
  StartupResult result;
  result.ready_ns = *ready_ns(*last);
  result.critical_path = PathBack(processes, conditions, steps, result.ready_ns).from(*last);
  result.begin_ns = result.critical_path.empty() ? result.ready_ns : result.critical_path.front().begin_ns;
  return result;
}

}  // namespace tracing
