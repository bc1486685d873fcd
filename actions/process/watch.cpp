// SPDX-License-Identifier: Apache-2.0
#include "actions/process/watch.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "actions/values/ros_condition.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/output_pattern.hpp"
#include "launcher/language/setting.hpp"

namespace launch {

namespace {

using Type = AttributeType;
using std::chrono::milliseconds;

const std::vector<std::string> kKinds = {"executor", "output", "blocked", "command"};
const std::vector<std::string> kReactions = {"none", "restart", "signal", "shutdown"};

// An attribute that only some kinds have.
struct KindAttribute {
  const char* name;
  const char* kind;
};
constexpr KindAttribute kKindAttributes[] = {{"pattern", "output"}, {"stream", "output"}, {"cmd", "command"}};

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
      {.attribute = {"kind", Type::kLiteral, true, "",
                     "what is watched: executor (the executors of the process go on), output (lines are printed), "
                     "blocked (the process is stopped, or hangs in the kernel) or command (it ends with exit code 0)",
                     true}},
      {.attribute = {"timeout", Type::kFloat, false, "5",
                     "seconds after which what does not go on, or a command that does not end, counts as a failure",
                     true},
       .perform = [](const Fields& fields, Scope& scope,
                     HealthWatch& watch) { perform_time<&HealthWatch::timeout>(fields, "timeout", scope, watch); }},
      {.attribute = {"interval", Type::kFloat, false,
                     "a fifth of timeout, 1 at most; of blocked half of timeout, 2 at most; of a command 10",
                     "seconds from one look to the next", true},
       .perform = [](const Fields& fields, Scope& scope,
                     HealthWatch& watch) { perform_time<&HealthWatch::interval>(fields, "interval", scope, watch); }},
      {.attribute = {"failures", Type::kInteger, false, "1; of a command 3",
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
      {.attribute = {"pattern", Type::kText, false, "any line",
                     "with output: regular expression to be found in the line", true}},
      {.attribute = {"stream", Type::kText, false, "both", "with output: stdout, stderr or both", true}},
      {.attribute = {"cmd", Type::kCommandLine, false, "",
                     "with command: the command line; split into words, not run by a shell", true}},
  };
  return settings;
}

std::string kind_given(const Fields& fields) {
  return kKinds[choice(fields, "kind", kKinds)];
}

WatchSubject perform_subject(const Fields& fields, Scope& scope) {
  const std::string kind = kind_given(fields);
  if (kind == "output") {
    const OutputPattern pattern = perform_output_pattern(fields, scope);
    return OutputLines{pattern.expression(), std::string(pattern.stream())};
  }
  if (kind == "blocked") {
    return NotBlocked{};
  }
  if (kind == "command") {
    CommandSucceeds command;
    for (const Template& word : fields.words("cmd")) {
      command.argv.push_back(word.perform(scope));
    }
    if (command.argv.empty() || command.argv.front().empty()) {
      throw LaunchError("the command is empty", fields.where("cmd"));
    }
    return command;
  }
  return ExecutorProgress{};
}

}  // namespace

ItemSpec WatchItem::item() {
  return {.tag = "watch",
          .help = "tells whether the process is healthy, and what follows when it is not",
          .attributes = declared_attributes(watch_settings()),
          .has_condition = true,
          .extension = true};
}

void WatchItem::check(const Fields& fields) {
  const std::string kind = kind_given(fields);
  for (const KindAttribute& attribute : kKindAttributes) {
    if (fields.has(attribute.name) && kind != attribute.kind) {
      throw LaunchError(fmt::format("{} goes with kind=\"{}\" only", attribute.name, attribute.kind),
                        fields.where(attribute.name), {}, Finding::kExclusive);
    }
  }
  const auto is_literal_or_missing = [&](const char* name) {
    return !fields.has(name) || fields.text(name).is_literal();
  };
  if (fields.has("signal") && is_literal_or_missing("on_unhealthy")) {
    Scope nothing;
    if (!fields.has("on_unhealthy") || fields.text("on_unhealthy").perform(nothing) != "signal") {
      throw LaunchError("signal goes with on_unhealthy=\"signal\" only", fields.where("signal"), {},
                        Finding::kExclusive);
    }
  }
  if (kind == "command" && !fields.has("cmd")) {
    throw LaunchError("a watch of kind=\"command\" needs a command", fields.where("kind"), "give cmd=\"…\"",
                      Finding::kMissingAttribute);
  }
  check_settings(watch_settings(), fields);
  if (Scope nothing; kind == "output" && is_literal_or_missing("pattern") && is_literal_or_missing("stream")) {
    perform_subject(fields, nothing);
  }
}

void WatchItem::perform(const Fields& fields, LaunchContext& context, ProcessSpec& spec) {
  Scope& scope = context.scope();
  if (!fields.condition().holds(scope)) {
    return;
  }
  HealthWatch watch;
  watch.signal = SIGABRT;
  watch.interval = Duration{0};
  watch.subject = perform_subject(fields, scope);
  const bool is_command = std::holds_alternative<CommandSucceeds>(watch.subject);
  watch.failures = is_command ? 3 : 1;
  perform_settings(watch_settings(), fields, scope, watch);
  if (watch.interval == Duration{0} && is_command) {
    watch.interval = std::chrono::seconds(10);
  } else if (watch.interval == Duration{0}) {
    // What blocks a process is looked up in /proc, which costs ten times as much as other looks.
    const bool is_dear = std::holds_alternative<NotBlocked>(watch.subject);
    const Duration longest = is_dear ? std::chrono::seconds(2) : std::chrono::seconds(1);
    watch.interval = std::clamp<Duration>(watch.timeout / (is_dear ? 2 : 5), milliseconds(50), longest);
  }
  watch.where = fields.where();
  spec.watches.push_back(std::move(watch));
}

}  // namespace launch
