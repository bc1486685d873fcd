// SPDX-License-Identifier: Apache-2.0
// Decides the conditions on what processes use of the machine, memory and processor time. It looks at the processes
// itself, some times in the window of each condition, so nothing needs to be recorded.
#pragma once

#include <sys/types.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/processes/process_usage.hpp"
#include "launcher/conditions/condition_watch.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class ProcessUsageWatch final : public ConditionWatch {
 public:
  struct Running {
    std::string label;
    pid_t pid = 0;
  };
  struct Sources {
    // The processes of the name that run on this machine.
    std::function<std::vector<Running>(const std::string& name)> find;
    // All names that the launch knows.
    std::function<std::vector<std::string>()> names;
    std::function<std::optional<ProcessUsage>(pid_t)> read = read_process_usage;
  };

  // The loop must outlive it.
  ProcessUsageWatch(EventLoop& loop, Sources sources) : loop_(loop), sources_(std::move(sources)) {}

  void observe(Tell tell) override { tell_ = std::move(tell); }
  void watch(tracing::ConditionId id, const tracing::LiveCondition& condition) override;
  void forget(tracing::ConditionId id) override { rules_.erase(id); }
  void close() override { rules_.clear(); }

 private:
  struct Sample {
    Duration time;
    ProcessUsage usage;
  };
  struct History {
    Duration since{0};                // the first look at the process
    std::deque<Sample> samples = {};  // of the window, and the last one before it
  };
  struct Rule {
    tracing::LiveCondition condition;
    Duration begin{0};
    std::map<pid_t, History> processes = {};
    bool was_seen = false;
    bool told_unseen = false;
    bool holds = false;
    Duration last_bad{0};  // when a process was above the limit last
    std::vector<pid_t> bad = {};
    EventLoop::SourcePtr timer = nullptr;
  };
  // What is held against the limit; nullopt: not known yet.
  struct Figure {
    double value = 0;
    bool is_above = false;
    bool was_above = false;  // at some time of the window
  };

  void look_later(tracing::ConditionId id);
  void look(tracing::ConditionId id, Rule& rule);
  std::optional<Figure> judge(const tracing::LiveCondition& condition, const std::deque<Sample>& samples) const;
  void tell_unseen(tracing::ConditionId id, Rule& rule);

  EventLoop& loop_;
  Sources sources_;
  Tell tell_;
  std::map<tracing::ConditionId, Rule> rules_;
};

}  // namespace launch
