// SPDX-License-Identifier: Apache-2.0
#include "actions/process/watch.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "actions/process/watch_subject.hpp"
#include "actions/values/ros_condition.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/setting.hpp"

namespace launch {

namespace {

using Type = AttributeType;
using std::chrono::milliseconds;

const std::vector<std::string> kReactions = {"none", "restart", "signal", "shutdown"};

void perform_reaction(const Fields& fields, Scope& scope, HealthWatch& watch) {
  const Template& text = fields.text("on_unhealthy");
  const std::string given = text.perform(scope);
  const auto found = std::find(kReactions.begin(), kReactions.end(), given);
  if (found == kReactions.end()) {
    throw LaunchError(fmt::format("on_unhealthy can be none, restart, signal or shutdown, got '{}'", given),
                      text.where(), given.empty() ? std::string() : did_you_mean(given, kReactions));
  }
  watch.reaction = static_cast<OnUnhealthy>(found - kReactions.begin());
}

void perform_signal(const Fields& fields, Scope& scope, HealthWatch& watch) {
  const Template& text = fields.text("signal");
  watch.signal = signal_of(text.perform(scope), text.where());
}

void perform_failures(const Fields& fields, Scope& scope, HealthWatch& watch) {
  watch.failures = static_cast<std::int64_t>(fields.number("failures")->perform(scope));
  if (watch.failures < 1) {
    throw LaunchError(fmt::format("failures must be at least 1, got {}", watch.failures), fields.where("failures"),
                      "1 makes the first failure count");
  }
}

template <Duration HealthWatch::*Member>
void perform_time(const Fields& fields, const char* name, Scope& scope, HealthWatch& watch) {
  NumberField number = *fields.number(name);
  number.require_not_negative();
  watch.*Member = as_duration(number.perform(scope));
  if (watch.*Member < milliseconds(1)) {
    throw LaunchError(fmt::format("{} must be at least 0.001 seconds", name), fields.where(name),
                      fmt::format("leave out {} to have its default", name));
  }
}

const std::vector<Setting<HealthWatch>>& watch_settings() {
  static const std::vector<Setting<HealthWatch>> settings = {
      {.attribute =
           {"kind", Type::kLiteral, true, "",
            "what is watched: executor (the executors of the process go on), output (lines are printed), "
            "blocked (the process is stopped, or hangs in the kernel), command (it ends with exit code 0), "
            "topic (messages come), service (it is there and answers), lifecycle (a node is in its state), "
            "port (a port or a socket accepts), notify (what sd_notify(3) tells), memory or load (the process uses "
            "no more than that)",
            true}},
      {.attribute = {"timeout", Type::kFloat, false, "5",
                     "seconds after which what does not go on, or does not answer, counts as a failure", true},
       .perform = [](const Fields& fields, Scope& scope,
                     HealthWatch& watch) { perform_time<&HealthWatch::timeout>(fields, "timeout", scope, watch); }},
      {.attribute = {"interval", Type::kFloat, false,
                     "a fifth of timeout, 1 at most; of blocked half of timeout, 2 at most; of service and lifecycle "
                     "half of timeout, 5 at most; of port 5; of a command 10",
                     "seconds from one look to the next", true},
       .perform = [](const Fields& fields, Scope& scope,
                     HealthWatch& watch) { perform_time<&HealthWatch::interval>(fields, "interval", scope, watch); }},
      {.attribute = {"failures", Type::kInteger, false, "1; of port and command 3",
                     "so many failures in a row make the process unhealthy", true},
       .perform = perform_failures},
      {.attribute = {"start_period", Type::kFloat, false, "0",
                     "seconds after the start in which failures do not count; the first success ends it", true},
       .place = place_of(&HealthWatch::start_period)},
      {.attribute = {"on_unhealthy", Type::kText, false, "none",
                     "what follows: none, restart of the process, signal, or shutdown of the launch", true},
       .perform = perform_reaction,
       .checks_literal = true},
      {.attribute = {"signal", Type::kText, false, "SIGABRT",
                     "with on_unhealthy=\"signal\": its name or its number; SIGABRT leaves a core", true},
       .perform = perform_signal,
       .checks_literal = true},
  };
  return settings;
}

std::string kind_given(const Fields& fields) {
  return watch_kinds()[choice(fields, "kind", watch_kinds())];
}

}  // namespace

ItemSpec WatchItem::item() {
  std::vector<AttributeSpec> attributes = declared_attributes(watch_settings());
  for (AttributeSpec& attribute : watch_subject_attributes()) {
    attributes.push_back(std::move(attribute));
  }
  return {.tag = "watch",
          .help = "tells whether the process is healthy, and what follows when it is not",
          .attributes = std::move(attributes),
          .has_condition = true,
          .extension = true};
}

void WatchItem::check(const Fields& fields) {
  check_watch_subject(fields, kind_given(fields));
  if (fields.has("signal") && (!fields.has("on_unhealthy") || fields.text("on_unhealthy").is_literal())) {
    Scope nothing;
    if (!fields.has("on_unhealthy") || fields.text("on_unhealthy").perform(nothing) != "signal") {
      throw LaunchError("signal goes with on_unhealthy=\"signal\" only", fields.where("signal"), {},
                        Finding::kExclusive);
    }
  }
  check_settings(watch_settings(), fields);
}

void WatchItem::perform(const Fields& fields, LaunchContext& context, ProcessSpec& spec) {
  Scope& scope = context.scope();
  if (!fields.condition().holds(scope)) {
    return;
  }
  HealthWatch watch;
  watch.signal = SIGABRT;
  watch.interval = Duration{0};
  watch.failures = 0;
  watch.subject = perform_watch_subject(fields, kind_given(fields), scope, spec);
  perform_settings(watch_settings(), fields, scope, watch);
  complete_watch(fields, watch);
  watch.where = fields.where();
  spec.watches.push_back(std::move(watch));
}

}  // namespace launch
