// SPDX-License-Identifier: Apache-2.0
#include "launcher/conditions/process_usage_watch.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace launch {
namespace {

using Kind = tracing::LiveCondition::Kind;

constexpr int kLooksInWindow = 10;
constexpr Duration kShortest = std::chrono::milliseconds(100);  // from one look to the next
constexpr Duration kLongest = std::chrono::seconds(1);

double seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

void ProcessUsageWatch::watch(tracing::ConditionId id, const tracing::LiveCondition& condition) {
  rules_.insert_or_assign(id, Rule{.condition = condition, .begin = loop_.now()});
  look_later(id);
}

void ProcessUsageWatch::look_later(tracing::ConditionId id) {
  Rule& rule = rules_.at(id);
  const Duration pause = std::clamp<Duration>(rule.condition.window / kLooksInWindow, kShortest, kLongest);
  rule.timer = loop_.after(pause, [this, id] {
    look(id, rules_.at(id));
    if (rules_.contains(id)) {  // nobody has forgotten it meanwhile
      look_later(id);
    }
  });
}

void ProcessUsageWatch::look(tracing::ConditionId id, Rule& rule) {
  const Duration now = loop_.now();
  const std::vector<Running> running = sources_.find(rule.condition.name);
  std::map<pid_t, History> processes;
  std::vector<pid_t> bad;
  tracing::ConditionChange change;
  for (const Running& process : running) {
    const std::optional<ProcessUsage> usage = sources_.read(process.pid);
    if (!usage) {
      continue;
    }
    const auto known = rule.processes.find(process.pid);
    History& history = processes[process.pid] = known == rule.processes.end() ? History{now} : std::move(known->second);
    std::deque<Sample>& own = history.samples;
    // What a process has got in its first window is its start, not its growth.
    const bool starts = rule.condition.kind == Kind::kGrowth && now - history.since < rule.condition.window;
    if (starts) {
      own.clear();
    }
    own.push_back({now, *usage});
    while (own.size() > 1 && own[1].time <= now - rule.condition.window) {
      own.pop_front();
    }
    const std::optional<Figure> figure = judge(rule.condition, own);
    if (figure && figure->was_above) {
      rule.last_bad = now;
    }
    if (figure && figure->is_above) {
      bad.push_back(process.pid);
      change.processes.push_back(process.label);
      change.figure = std::max(change.figure, figure->value);
    }
  }
  rule.processes = std::move(processes);
  rule.was_seen |= !running.empty();
  tell_unseen(id, rule);
  const bool has_ended =
      std::none_of(rule.bad.begin(), rule.bad.end(), [&](pid_t pid) { return rule.processes.contains(pid); });
  const bool is_over = bad.empty() && rule.holds && (has_ended || now - rule.last_bad >= rule.condition.window);
  if (!bad.empty()) {
    rule.bad = std::move(bad);
  } else if (is_over) {
    rule.bad.clear();
  }
  if (is_over || (!rule.bad.empty() && !rule.holds)) {
    change.holds = rule.holds = !is_over;
    if (is_over) {
      std::transform(running.begin(), running.end(), std::back_inserter(change.processes),
                     [](const Running& process) { return process.label; });
    }
    loop_.post([this, id, change] {
      if (rules_.contains(id)) {
        tell_(tracing::ConditionChanged{id, change});
      }
    });
  }
}

// Memory must be above its limit for the whole window, the share of a processor is that of the window, and growth is
// counted from the least amount in the window.
std::optional<ProcessUsageWatch::Figure> ProcessUsageWatch::judge(const tracing::LiveCondition& condition,
                                                                  const std::deque<Sample>& samples) const {
  const double limit = condition.above.value_or(0);
  const Sample& last = samples.back();
  const bool is_whole = last.time - samples.front().time >= condition.window;
  const auto memory = [](const Sample& sample) { return static_cast<double>(sample.usage.memory); };
  if (condition.kind == Kind::kMemory) {
    const auto is_above = [&](const Sample& sample) { return memory(sample) > limit; };
    return Figure{memory(last), is_whole && std::all_of(samples.begin(), samples.end(), is_above), is_above(last)};
  }
  if (condition.kind == Kind::kGrowth) {
    const auto least = std::min_element(samples.begin(), samples.end(),
                                        [&](const Sample& a, const Sample& b) { return memory(a) < memory(b); });
    const double grown = memory(last) - memory(*least);
    return Figure{grown, grown > limit, grown > limit};
  }
  if (!is_whole) {
    return std::nullopt;
  }
  const double share = (last.usage.cpu - samples.front().usage.cpu) / seconds(last.time - samples.front().time);
  return Figure{share, share > limit, share > limit};
}

void ProcessUsageWatch::tell_unseen(tracing::ConditionId id, Rule& rule) {
  if (rule.was_seen || rule.told_unseen || loop_.now() - rule.begin < rule.condition.grace) {
    return;
  }
  rule.told_unseen = true;
  loop_.post([this, id] {
    if (rules_.contains(id)) {
      tell_(tracing::NameNotSeen{id, sources_.names()});
    }
  });
}

}  // namespace launch
