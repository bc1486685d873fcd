// SPDX-License-Identifier: Apache-2.0
// When a condition holds: what has happened, and what has not, in the time of the trace.
#include <algorithm>
#include <utility>

#include "tracing/show/live/live_conditions.hpp"

namespace tracing {
namespace {

using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;

constexpr std::int64_t kLeastBetweenTrackers = 10'000'000'000;
constexpr int kCallsToBelieve = 16;  // if all of them are late, the timer is due later than was thought

}  // namespace

std::int64_t LiveConditions::counts_from(const Rule& rule) const {
  return std::max(rule.seen_ns.value_or(0), doubt_ns_);
}

void LiveConditions::on_publication(const Publication& publication) {
  if (chains_ && is_ours(publication.thread.process)) {
    chains_->on_publication(publication);
  }
  if (publication.publisher >= of_publisher_.size() || of_publisher_[publication.publisher].empty()) {
    return;
  }
  // A message within the process goes through the middleware, too, if there are subscriptions elsewhere.
  if (publication.intra_process) {
    intra_process_.insert(publication.publisher);
  }
  const bool is_second_copy = !publication.intra_process && intra_process_.contains(publication.publisher);
  for (Rule* const rule : of_publisher_[publication.publisher]) {
    if (rule->condition.kind != Kind::kRate || !is_second_copy) {
      happened(*rule, publication.published_ns);
    }
  }
}

void LiveConditions::on_message(const MessageFlow& message) {
  // One that was there before the subscription, as subscriptions that are transient local get it, was not on its way
  // all the time.
  const bool is_older = message.publication.published_ns != 0 && message.subscription < subscription_since_.size() &&
                        message.publication.published_ns < subscription_since_[message.subscription];
  if (chains_ && is_ours(message.taking_thread.process) && !is_older) {
    chains_->on_message(message);
  }
  count_missed(message);
  if (is_older || message.publication.published_ns == 0 || message.callback_begin_ns == 0 || message.is_estimated ||
      message.subscription >= of_subscription_.size()) {
    return;
  }
  for (Rule* const rule : of_subscription_[message.subscription]) {
    if (rule->condition.kind == Kind::kLate) {
      took(*rule, message.publication.published_ns, message.callback_begin_ns);
    }
  }
}

void LiveConditions::on_message_link(const MessageLink& link) {
  if (chains_) {
    chains_->on_message_link(link);
  }
}

// A gap before a message shows that messages were lost. Around lost events a gap may be theirs.
void LiveConditions::count_missed(const MessageFlow& message) {
  const bool is_wanted =
      message.subscription < of_subscription_.size() &&
      std::any_of(of_subscription_[message.subscription].begin(), of_subscription_[message.subscription].end(),
                  [](const Rule* rule) { return rule->condition.kind == Kind::kLoss; });
  if (!is_wanted) {
    return;
  }
  Missed& missed = missed_[message.subscription];
  const std::uint64_t before = std::exchange(missed.count, analysis_.dropped_messages(message.subscription));
  const std::int64_t last_ns = std::exchange(missed.last_ns, message.taken_ns);
  const std::uint64_t more = last_ns > doubt_ns_ ? missed.count - std::min(before, missed.count) : 0;
  const bool arrived = message.callback != kNoObject || message.needs_no_callback;
  for (Rule* const rule : of_subscription_[message.subscription]) {
    if (rule->condition.kind == Kind::kLoss) {
      lost(*rule, more, arrived, message.taken_ns);
    }
  }
}

void LiveConditions::on_call(const ServiceCall& call) {
  if (call.sent_ns == 0 || call.received_ns == 0 || call.client >= of_client_.size()) {
    return;
  }
  for (Rule* const rule : of_client_[call.client]) {
    took(*rule, call.sent_ns, call.received_ns);
  }
}

const std::vector<LiveConditions::Rule*>& LiveConditions::rules_of_node(ObjectId callback) const {
  static const std::vector<Rule*> none;
  const ObjectModel& objects = analysis_.objects();
  const ObjectId node = objects.node_of(objects.callbacks()[callback]);
  return node < of_node_.size() ? of_node_[node] : none;
}

void LiveConditions::on_callback_begin(const CallbackInstance& instance) {
  if (chains_ && is_ours(instance.thread.process)) {
    chains_->on_callback_begin(instance);
  }
  const std::vector<Rule*>& rules = rules_of_node(instance.callback);
  if (std::any_of(rules.begin(), rules.end(), is_about_callbacks)) {
    running_.push_back({instance.thread, instance.callback, instance.begin_ns});
  }
  if (std::any_of(rules.begin(), rules.end(),
                  [](const Rule* rule) { return rule->condition.subject == Subject::kTimer; })) {
    timer_begins(instance, rules);
  }
}

// A timer is due one period after it was due before. If it is called later than its next period, those that have passed
// are left out. When it was due first is not in the trace: the earliest call shows it.
void LiveConditions::timer_begins(const CallbackInstance& instance, const std::vector<Rule*>& rules) {
  const ObjectModel& objects = analysis_.objects();
  const CallbackObject& callback = objects.callbacks()[instance.callback];
  const bool is_timer = callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject;
  const std::int64_t period_ns = is_timer ? objects.timers()[callback.owner_id].period_ns : 0;
  if (period_ns <= 0) {
    return;
  }
  const auto [known, is_new] = due_.try_emplace(instance.callback);
  Due& due = known->second;
  if (is_new || due.due_ns < doubt_ns_) {
    due = {.due_ns = instance.begin_ns + period_ns};
    return;
  }
  due.due_ns = std::min(due.due_ns, instance.begin_ns);
  const std::int64_t late_ns = instance.begin_ns - due.due_ns;
  for (Rule* const rule : rules) {
    if (rule->condition.subject == Subject::kTimer) {
      took(*rule, due.due_ns, instance.begin_ns);
    }
  }
  due.due_ns += (late_ns / period_ns + 1) * period_ns;
  due.least_late_ns = due.calls == 0 ? late_ns : std::min(due.least_late_ns, late_ns);
  due.most_late_ns = due.calls == 0 ? late_ns : std::max(due.most_late_ns, late_ns);
  if (++due.calls == kCallsToBelieve) {
    // A timer that was set anew is late by the same time at each call, one that has to wait is not.
    if (due.most_late_ns - due.least_late_ns <= due.least_late_ns / 4) {
      due.due_ns += due.least_late_ns;
    }
    due.calls = 0;
  }
}

void LiveConditions::on_callback(const CallbackInstance& instance) {
  if (chains_ && is_ours(instance.thread.process)) {
    chains_->on_callback(instance);
  }
  std::set<ConditionId> late;
  const auto running = std::find_if(running_.begin(), running_.end(), [&](const Running& each) {
    return each.thread == instance.thread && each.callback == instance.callback && each.begin_ns == instance.begin_ns;
  });
  if (running != running_.end()) {
    late = std::move(running->late);
    running_.erase(running);
  }
  if (!instance.finished) {
    return;
  }
  for (Rule* const rule : rules_of_node(instance.callback)) {
    if (rule->condition.kind == Kind::kSilence) {
      happened(*rule, instance.end_ns);
    } else if (is_about_callbacks(rule) && !late.contains(rule->id)) {
      took(*rule, instance.begin_ns, instance.end_ns);
    }
  }
}

// What runs for too long is late before it ends.
void LiveConditions::look_at_running() {
  std::erase_if(running_, [this](const Running& running) {
    const std::optional<std::int64_t> vpid = vpid_of(running.thread.process);
    return !vpid || !processes_.lives(*vpid);
  });
  for (Running& running : running_) {
    for (Rule* const rule : rules_of_node(running.callback)) {
      if (is_about_callbacks(rule) && now_ns_ - running.begin_ns > rule->condition.max.count() &&
          running.late.insert(rule->id).second) {
        took(*rule, running.begin_ns, now_ns_);
      }
    }
  }
}

void LiveConditions::happened(Rule& rule, std::int64_t time_ns) {
  check(rule, time_ns);
  rule.last_ns = std::max(rule.last_ns, time_ns);
  if (!rule.seen_ns) {
    rule.seen_ns = time_ns;
  }
  if (rule.condition.kind == Kind::kRate) {
    rule.parts.add(false);
  } else if (rule.holds) {
    change(rule, false, seconds_in(time_ns - rule.since_ns));
  }
}

// If events were lost meanwhile, the begin may be that of one and the end that of a later one. A share is known when
// nothing was lost in its whole window.
void LiveConditions::took(Rule& rule, std::int64_t begin_ns, std::int64_t end_ns) {
  check(rule, end_ns);
  if (!rule.seen_ns) {
    rule.seen_ns = end_ns;
  }
  if (begin_ns < doubt_ns_) {
    return;
  }
  const bool is_too_long = end_ns - begin_ns > rule.condition.max.count();
  rule.parts.add(is_too_long);
  if (is_too_long) {
    look_at_share(rule, end_ns, seconds_in(end_ns - begin_ns));
  }
}

void LiveConditions::lost(Rule& rule, std::uint64_t count, bool arrived, std::int64_t time_ns) {
  check(rule, time_ns);
  if (!rule.seen_ns) {
    rule.seen_ns = time_ns;
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    rule.parts.add(true);
  }
  if (arrived) {
    rule.parts.add(false);
  }
  if (count > 0) {
    look_at_share(rule, time_ns, static_cast<double>(rule.parts.late_sum));
  }
}

void LiveConditions::look_at_share(Rule& rule, std::int64_t time_ns, double figure) {
  const bool is_sure = rule.condition.share >= 1 || time_ns - rule.condition.window.count() >= doubt_ns_;
  if (!is_late(rule) || !is_sure) {
    return;
  }
  rule.last_bad_ns = time_ns;
  if (!rule.holds) {
    change(rule, true, figure);
  }
}

bool LiveConditions::is_late(const Rule& rule) const {
  constexpr double kRounding = 1e-9;
  return rule.parts.late_share() > 1 - rule.condition.share + kRounding;
}

void LiveConditions::Parts::add(bool is_late) {
  const auto place = static_cast<std::size_t>(current % kCount);
  ++counts[place];
  ++sum;
  if (is_late) {
    ++late[place];
    ++late_sum;
  }
}

void LiveConditions::Parts::step() {
  ++current;
  const auto oldest = static_cast<std::size_t>(current % kCount);
  sum -= std::exchange(counts[oldest], 0);
  late_sum -= std::exchange(late[oldest], 0);
}

void LiveConditions::advance(std::int64_t until_ns) {
  now_ns_ = std::max(now_ns_, until_ns);
  // Callbacks of processes that have ended are among those that it knows.
  if (chains_ && chains_->is_full() && now_ns_ - chains_since_ns_ > kLeastBetweenTrackers) {
    follow_chains();
  }
  look_at_running();
  for (auto& [id, rule] : rules_) {
    check(rule, now_ns_);
  }
}

void LiveConditions::check(Rule& rule, std::int64_t until_ns) {
  if (rule.condition.kind != Kind::kSilence) {
    check_window(rule, until_ns);
  } else if (rule.seen_ns && !rule.holds) {
    check_silence(rule, until_ns);
  } else if (rule.holds && rule.condition.subject == Subject::kNode && !lives(rule)) {
    // A node that has ended does not hang.
    change(rule, false, seconds_in(until_ns - rule.since_ns));
    rule.seen_ns.reset();
  }
}

void LiveConditions::check_silence(Rule& rule, std::int64_t until_ns) {
  const std::int64_t begin_ns = std::max(counts_from(rule), rule.last_ns);
  if (until_ns - begin_ns < rule.condition.window.count()) {
    return;
  }
  // A node that has ended does not hang.
  if (rule.condition.subject == LiveCondition::Subject::kNode && !lives(rule)) {
    rule.seen_ns.reset();
    return;
  }
  rule.since_ns = begin_ns;
  change(rule, true, seconds_in(until_ns - begin_ns));
}

void LiveConditions::check_window(Rule& rule, std::int64_t until_ns) {
  Parts& parts = rule.parts;
  const std::int64_t part_ns = std::max<std::int64_t>(1, rule.condition.window.count() / Parts::kCount);
  const std::int64_t now = until_ns / part_ns;
  if (parts.current == 0 || !rule.seen_ns) {
    parts = {.current = now};
    return;
  }
  while (parts.current < now) {
    const std::int64_t end_ns = (parts.current + 1) * part_ns;
    if (rule.condition.kind == Kind::kRate) {
      check_rate_part(rule, end_ns);
    } else {
      check_late_part(rule, end_ns);
    }
    parts.step();
  }
}

// Messages in the window, in Hz.
double LiveConditions::rate_of(const Rule& rule) {
  return static_cast<double>(rule.parts.sum) / seconds_in(rule.condition.window.count());
}

// For a whole window nothing was too late.
void LiveConditions::check_late_part(Rule& rule, std::int64_t end_ns) {
  if (rule.holds && !is_late(rule) && end_ns - rule.last_bad_ns >= rule.condition.window.count()) {
    change(rule, false, 0);
  }
}

// Looks at the window that ends with a part.
void LiveConditions::check_rate_part(Rule& rule, std::int64_t end_ns) {
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
  tell_(ConditionChanged{rule.id,
                         {.holds = holds,
                          .figure = figure,
                          .processes = {told.begin(), told.end()},
                          .late = holds ? rule.parts.late_share() : 0}});
}

}  // namespace tracing
