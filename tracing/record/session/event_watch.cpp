// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/event_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// liblttng-ctl has no call that waits for a notification and can be ended, nor a descriptor to wait on.
constexpr std::chrono::milliseconds kBetweenLooks{2};

std::string trigger_name(const std::string& name, std::size_t number) {
  return fmt::format("{}:{}", name, number);
}

LttngOwned<lttng_event_rule> make_rule(const EventRule& rule) {
  LttngOwned<lttng_event_rule> made(lttng_event_rule_user_tracepoint_create(), lttng_event_rule_destroy);
  const auto check = [&rule](lttng_event_rule_status status) {
    if (status != LTTNG_EVENT_RULE_STATUS_OK) {
      throw TraceError(fmt::format("LTTng does not watch for event '{}'", rule.pattern),
                       "name it as in events-ust, with a simpler filter");
    }
  };
  check(made != nullptr ? LTTNG_EVENT_RULE_STATUS_OK : LTTNG_EVENT_RULE_STATUS_ERROR);
  check(lttng_event_rule_user_tracepoint_set_name_pattern(made.get(), rule.pattern.c_str()));
  if (!rule.filter.empty()) {
    check(lttng_event_rule_user_tracepoint_set_filter(made.get(), rule.filter.c_str()));
  }
  if (rule.log_level) {
    const LttngOwned<lttng_log_level_rule> level(
        rule.exactly_that_level ? lttng_log_level_rule_exactly_create(*rule.log_level)
                                : lttng_log_level_rule_at_least_as_severe_as_create(*rule.log_level),
        lttng_log_level_rule_destroy);
    check(lttng_event_rule_user_tracepoint_set_log_level_rule(made.get(), level.get()));
  }
  return made;
}

}  // namespace

void EventWatch::TriggerDeleter::operator()(lttng_trigger* trigger) const {
  lttng_trigger_destroy(trigger);
}

void EventWatch::ChannelDeleter::operator()(lttng_notification_channel* channel) const {
  lttng_notification_channel_destroy(channel);
}

EventWatch::EventWatch(const std::string& name, const std::vector<std::string>& rules,
                       std::function<void(const std::string&)> seen)
    : seen_(std::move(seen)), channel_(lttng_notification_channel_create(lttng_notification_endpoint())) {
  if (!channel_) {
    throw TraceError("cannot watch for events: the session daemon does not answer");
  }
  try {
    for (const std::string& rule : rules) {
      add(name, rule);
    }
  } catch (const TraceError&) {
    unregister();
    throw;
  }
  thread_ = std::thread([this] { wait_for_events(); });
}

EventWatch::~EventWatch() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_one();
  thread_.join();
  unregister();
}

void EventWatch::add(const std::string& name, const std::string& text) {
  for (const EventRule& rule : expand_exclusions(parse_event_rule(text))) {
    add(name, rule, text);
  }
}

void EventWatch::add(const std::string& name, const EventRule& parsed, const std::string& text) {
  const LttngOwned<lttng_event_rule> rule = make_rule(parsed);
  const LttngOwned<lttng_condition> condition(lttng_condition_event_rule_matches_create(rule.get()),
                                              lttng_condition_destroy);
  // In a list, as `lttng add-trigger` makes it: `lttng list-triggers` aborts at an action that stands alone.
  const LttngOwned<lttng_action> notify(lttng_action_notify_create(), lttng_action_destroy);
  const LttngOwned<lttng_action> action(lttng_action_list_create(), lttng_action_destroy);
  lttng_action_list_add_action(action.get(), notify.get());
  std::unique_ptr<lttng_trigger, TriggerDeleter> trigger(lttng_trigger_create(condition.get(), action.get()));
  const std::string unique = trigger_name(name, rules_.size());
  const std::string doing = fmt::format("watch for event '{}'", text);
  if (const lttng_error_code code = lttng_register_trigger_with_name(trigger.get(), unique.c_str()); code != LTTNG_OK) {
    throw lttng_error(code, doing);
  }
  triggers_.push_back(std::move(trigger));
  rules_.emplace_back(unique, text);
  if (lttng_notification_channel_subscribe(channel_.get(), condition.get()) != LTTNG_NOTIFICATION_CHANNEL_STATUS_OK) {
    throw lttng_error(LTTNG_ERR_UNK, doing);
  }
}

void EventWatch::unregister() {
  for (const auto& trigger : triggers_) {
    lttng_unregister_trigger(trigger.get());
  }
  triggers_.clear();
}

void EventWatch::wait_for_events() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    lock.unlock();
    while (tell_next()) {
    }
    lock.lock();
    stopped_.wait_for(lock, kBetweenLooks, [this] { return stop_; });
  }
}

// False when nothing is pending, or nothing will be any more.
bool EventWatch::tell_next() {
  bool pending = false;
  if (lttng_notification_channel_has_pending_notification(channel_.get(), &pending) !=
          LTTNG_NOTIFICATION_CHANNEL_STATUS_OK ||
      !pending) {
    return false;
  }
  lttng_notification* received = nullptr;
  const auto status = lttng_notification_channel_get_next_notification(channel_.get(), &received);
  const LttngOwned<lttng_notification> notification(received, lttng_notification_destroy);
  // LTTng drops notifications that come too fast. The notifications that arrive suffice to report the event.
  if (status == LTTNG_NOTIFICATION_CHANNEL_STATUS_NOTIFICATIONS_DROPPED) {
    return true;
  }
  if (status != LTTNG_NOTIFICATION_CHANNEL_STATUS_OK) {
    return false;
  }
  const char* name = nullptr;
  if (lttng_trigger_get_name(lttng_notification_get_trigger(received), &name) != LTTNG_TRIGGER_STATUS_OK) {
    return true;
  }
  const auto rule = std::find_if(rules_.begin(), rules_.end(), [&](const auto& entry) { return entry.first == name; });
  if (rule != rules_.end()) {
    seen_(rule->second);
  }
  return true;
}

void EventWatch::clean_up(const std::string& name) {
  lttng_triggers* listed = nullptr;
  if (lttng_list_triggers(&listed) != LTTNG_OK) {
    return;
  }
  const LttngOwned<lttng_triggers> triggers(listed, lttng_triggers_destroy);
  unsigned int count = 0;
  lttng_triggers_get_count(listed, &count);
  for (unsigned int i = 0; i < count; ++i) {
    const lttng_trigger* const trigger = lttng_triggers_get_at_index(listed, i);
    const char* found = nullptr;
    if (lttng_trigger_get_name(trigger, &found) != LTTNG_TRIGGER_STATUS_OK) {
      continue;
    }
    if (std::string(found).starts_with(name + ":")) {
      lttng_unregister_trigger(trigger);
    }
  }
}

}  // namespace tracing
