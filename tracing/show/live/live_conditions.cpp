// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_conditions.hpp"

#include <algorithm>
#include <utility>

namespace tracing {
namespace {

using Subject = LiveCondition::Subject;

double seconds_in(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e9;
}

}  // namespace

LiveConditions::LiveConditions(LaunchedProcesses& processes, Tell tell)
    : processes_(processes), tell_(std::move(tell)), analysis_(this) {}

void LiveConditions::watch(ConditionId id, const LiveCondition& condition) {
  forget(id);
  Rule& rule = rules_.emplace(id, Rule{.id = id, .condition = condition}).first->second;
  // What is there already counts as seen now.
  const ObjectModel& objects = analysis_.objects();
  for (ObjectId i = 0; i < of_publisher_.size(); ++i) {
    if (is_named(rule, objects.publishers()[i])) {
      of_publisher_[i].push_back(&rule);
      see(rule, objects.publishers()[i].process);
    }
  }
  for (ObjectId i = 0; i < of_node_.size(); ++i) {
    if (is_named(rule, objects.nodes()[i])) {
      of_node_[i].push_back(&rule);
      see(rule, objects.nodes()[i].process);
    }
  }
}

void LiveConditions::forget(ConditionId id) {
  const auto found = rules_.find(id);
  if (found == rules_.end()) {
    return;
  }
  for (std::vector<std::vector<Rule*>>* const index : {&of_publisher_, &of_node_}) {
    for (std::vector<Rule*>& rules : *index) {
      std::erase(rules, &found->second);
    }
  }
  rules_.erase(found);
}

void LiveConditions::on_event(const Event& event) {
  now_ns_ = std::max(now_ns_, event.timestamp_ns);
  analysis_.on_event(event);
  if (of_publisher_.size() != analysis_.objects().publishers().size() ||
      of_node_.size() != analysis_.objects().nodes().size()) {
    find_objects();
  }
}

void LiveConditions::on_loss(const Loss& loss) {
  doubt_ns_ = std::max(doubt_ns_, loss.end_ns.value_or(now_ns_));
  analysis_.on_loss(loss);
}

bool LiveConditions::is_named(const Rule& rule, const EndpointObject& publisher) {
  return rule.condition.subject == Subject::kTopic && publisher.topic != kNoObject &&
         analysis_.objects().topics()[publisher.topic].name == rule.condition.name && is_ours(publisher.process);
}

bool LiveConditions::is_named(const Rule& rule, const NodeObject& node) {
  return rule.condition.subject == Subject::kNode && node.name == rule.condition.name && is_ours(node.process);
}

void LiveConditions::find_objects() {
  const ObjectModel& objects = analysis_.objects();
  const auto find = [this](const auto& all, std::vector<std::vector<Rule*>>& index) {
    while (index.size() < all.size()) {
      const auto& object = all[index.size()];
      std::vector<Rule*>& waiting = index.emplace_back();
      for (auto& [id, rule] : rules_) {
        if (is_named(rule, object)) {
          waiting.push_back(&rule);
          see(rule, object.process);
        }
      }
    }
  };
  find(objects.publishers(), of_publisher_);
  find(objects.nodes(), of_node_);
}

std::optional<std::int64_t> LiveConditions::vpid_of(ProcessId process) const {
  return process < analysis_.processes().size() ? analysis_.processes()[process].vpid : std::nullopt;
}

bool LiveConditions::is_ours(ProcessId process) {
  const auto [known, is_new] = ours_.try_emplace(process, false);
  if (is_new) {
    const std::optional<std::int64_t> vpid = vpid_of(process);
    known->second = vpid && processes_.label(*vpid);
  }
  return known->second;
}

// A new object of the name begins the count anew, unless another one is at work and all is well.
void LiveConditions::see(Rule& rule, ProcessId process) {
  check(rule, now_ns_);
  const bool was_alone = !lives(rule);
  std::erase_if(rule.processes, [&](ProcessId other) {
    const std::optional<std::int64_t> vpid = vpid_of(other);
    return !vpid || !processes_.lives(*vpid);
  });
  rule.processes.insert(process);
  rule.was_seen = true;
  if (rule.holds) {
    change(rule, false, rule.condition.kind == LiveCondition::Kind::kSilence ? seconds_in(now_ns_ - rule.since_ns) : 0);
    rule.seen_ns = now_ns_;
  } else if (!rule.seen_ns || was_alone) {
    rule.seen_ns = now_ns_;
  }
}

bool LiveConditions::lives(const Rule& rule) {
  return std::any_of(rule.processes.begin(), rule.processes.end(), [&](ProcessId process) {
    const std::optional<std::int64_t> vpid = vpid_of(process);
    return vpid && processes_.lives(*vpid);
  });
}

std::int64_t LiveConditions::counts_from(const Rule& rule) const {
  return std::max(rule.seen_ns.value_or(0), doubt_ns_);
}

void LiveConditions::on_publication(const Publication& publication) {
  if (publication.publisher < of_publisher_.size()) {
    for (Rule* const rule : of_publisher_[publication.publisher]) {
      happened(*rule, publication.published_ns);
    }
  }
}

void LiveConditions::on_callback(const CallbackInstance& instance) {
  if (!instance.finished) {
    return;
  }
  const ObjectModel& objects = analysis_.objects();
  const ObjectId node = objects.node_of(objects.callbacks()[instance.callback]);
  if (node != kNoObject && node < of_node_.size()) {
    for (Rule* const rule : of_node_[node]) {
      happened(*rule, instance.end_ns);
    }
  }
}

void LiveConditions::happened(Rule& rule, std::int64_t time_ns) {
  check(rule, time_ns);
  rule.last_ns = std::max(rule.last_ns, time_ns);
  if (!rule.seen_ns) {
    rule.seen_ns = time_ns;
  }
  if (rule.condition.kind == LiveCondition::Kind::kRate) {
    ++rule.parts.counts[static_cast<std::size_t>(rule.parts.current % Parts::kCount)];
    ++rule.parts.sum;
  } else if (rule.holds) {
    change(rule, false, seconds_in(time_ns - rule.since_ns));
  }
}

void LiveConditions::advance(std::int64_t until_ns) {
  now_ns_ = std::max(now_ns_, until_ns);
  for (auto& [id, rule] : rules_) {
    check(rule, now_ns_);
  }
}

void LiveConditions::check(Rule& rule, std::int64_t until_ns) {
  if (rule.condition.kind == LiveCondition::Kind::kRate) {
    check_rate(rule, until_ns);
  } else if (rule.seen_ns && !rule.holds) {
    check_silence(rule, until_ns);
  }
}

void LiveConditions::check_silence(Rule& rule, std::int64_t until_ns) {
  const std::int64_t begin_ns = std::max(counts_from(rule), rule.last_ns);
  if (until_ns - begin_ns < rule.condition.window.count()) {
    return;
  }
  // A node that has ended does not hang.
  if (rule.condition.subject == Subject::kNode && !lives(rule)) {
    rule.seen_ns.reset();
    return;
  }
  rule.since_ns = begin_ns;
  change(rule, true, seconds_in(until_ns - begin_ns));
}

void LiveConditions::check_rate(Rule& rule, std::int64_t until_ns) {
  Parts& parts = rule.parts;
  const std::int64_t part_ns = std::max<std::int64_t>(1, rule.condition.window.count() / Parts::kCount);
  const std::int64_t now = until_ns / part_ns;
  if (parts.current == 0 || !rule.seen_ns) {
    parts = {.current = now};
    return;
  }
  while (parts.current < now) {
    check_part(rule, (parts.current + 1) * part_ns);
    ++parts.current;
    std::uint32_t& oldest = parts.counts[static_cast<std::size_t>(parts.current % Parts::kCount)];
    parts.sum -= oldest;
    oldest = 0;
  }
}

// Looks at the window that ends with a part.
void LiveConditions::check_part(Rule& rule, std::int64_t end_ns) {
  const LiveCondition& condition = rule.condition;
  if (end_ns - condition.window.count() < counts_from(rule)) {
    return;
  }
  const double count = static_cast<double>(rule.parts.sum);
  const double seconds = seconds_in(condition.window.count());
  // Which messages fall into a window is a matter of its borders, so one of them more or less says nothing.
  const bool is_bad =
      condition.below ? count + 1 < *condition.below * seconds : count - 1 > condition.above.value_or(0) * seconds;
  if (is_bad) {
    rule.last_bad_ns = end_ns;
    if (!rule.holds) {
      change(rule, true, count / seconds);
    }
  } else if (rule.holds && end_ns - rule.last_bad_ns >= condition.window.count()) {
    change(rule, false, count / seconds);
  }
}

void LiveConditions::change(Rule& rule, bool holds, double figure) {
  rule.holds = holds;
  std::set<std::string> living;
  std::set<std::string> all;
  for (const ProcessId process : rule.processes) {
    const std::optional<std::int64_t> vpid = vpid_of(process);
    const std::optional<std::string> label = vpid ? processes_.label(*vpid) : std::nullopt;
    if (label) {
      all.insert(*label);
      if (processes_.lives(*vpid)) {
        living.insert(*label);
      }
    }
  }
  const std::set<std::string>& told = living.empty() ? all : living;
  tell_(ConditionChanged{rule.id, {holds, figure, {told.begin(), told.end()}}});
}

void LiveConditions::tell_unseen(std::chrono::nanoseconds now) {
  for (auto& [id, rule] : rules_) {
    if (rule.was_seen || rule.told_unseen) {
      continue;
    }
    if (!rule.unseen_since) {
      rule.unseen_since = now;
    }
    if (now - *rule.unseen_since < rule.condition.grace) {
      continue;
    }
    rule.told_unseen = true;
    std::set<std::string> known;
    const ObjectModel& objects = analysis_.objects();
    if (rule.condition.subject == Subject::kTopic) {
      for (const EndpointObject& publisher : objects.publishers()) {
        if (publisher.topic != kNoObject && is_ours(publisher.process)) {
          known.insert(objects.topics()[publisher.topic].name);
        }
      }
    } else {
      for (const NodeObject& node : objects.nodes()) {
        if (is_ours(node.process)) {
          known.insert(node.name);
        }
      }
    }
    tell_(NameNotSeen{id, {known.begin(), known.end()}});
  }
}

}  // namespace tracing
