// SPDX-License-Identifier: Apache-2.0
#include "actions/process/process_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "actions/process/control_group_settings.hpp"
#include "actions/process/cpu_faults.hpp"
#include "actions/process/depends_on.hpp"
#include "actions/process/machine_settings.hpp"
#include "actions/process/resource_settings.hpp"
#include "actions/process/terminal_settings.hpp"
#include "actions/process/watch.hpp"
#include "actions/values/pair_items.hpp"
#include "base/processes/process_mark.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

// Reads "screen,log", "none" and the like.
OutputTargets targets(const Template& given, Scope& scope) {
  const std::string text = given.perform(scope);
  OutputTargets targets;
  for (std::size_t begin = 0; begin <= text.size() && text != "none";) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (word == "screen") {
      targets.screen = true;
    } else if (word == "log") {
      targets.log = true;
    } else if (word == "own_log") {
      targets.own_log = true;
    } else {
      if (word == "none") {
        throw LaunchError("'none' stands alone", given.where(), "leave the other places out, or leave none out");
      }
      const std::string suggestion = did_you_mean(word, {"screen", "log", "own_log", "none"});
      throw LaunchError(fmt::format("'{}' is no place for output, expected screen, log, own_log or none", word),
                        given.where(), suggestion.empty() ? "write several with commas: screen,log" : suggestion);
    }
    begin = end + 1;
  }
  return targets;
}

const std::string* find_configuration(const Scope& scope, const std::string& name) {
  const auto found = scope.configurations.find(name);
  return found == scope.configurations.end() ? nullptr : &found->second;
}

std::vector<std::string> launch_prefix(const Fields& fields, Scope& scope, const std::string& program) {
  if (fields.has("launch-prefix")) {
    return split_shell_words(fields.text("launch-prefix").perform(scope), fields.where("launch-prefix"));
  }
  const std::string* const prefix = find_configuration(scope, "launch-prefix");
  if (prefix == nullptr) {
    return {};
  }
  if (const std::string* const filter = find_configuration(scope, "launch-prefix-filter")) {
    try {
      const std::regex expression(*filter);
      const std::string name = std::filesystem::path(program).filename().string();
      if (!std::regex_search(name, expression, std::regex_constants::match_continuous)) {
        return {};
      }
    } catch (const std::regex_error& error) {
      throw LaunchError(fmt::format("launch-prefix-filter '{}' is not a regular expression: {}", *filter, error.what()),
                        fields.where());
    }
  }
  return split_shell_words(*prefix, fields.where());
}

OutputRouting output(const Fields& fields, LaunchContext& context) {
  const Environment& environment = context.initial_environment();
  const auto variable = environment.find("OVERRIDE_LAUNCH_PROCESS_OUTPUT");
  const std::string everywhere = !context.wishes().process_output.empty() ? context.wishes().process_output
                                 : variable != environment.end()          ? variable->second
                                                                          : "";
  const bool overridden = !everywhere.empty();
  Scope& scope = context.scope();
  const std::string mode = overridden             ? everywhere
                           : fields.has("output") ? fields.text("output").perform(scope)
                                                  : std::string("log");
  const std::optional<OutputRouting> routing = OutputRouting::from_mode(mode);
  if (!routing) {
    throw LaunchError(fmt::format("'{}' is not a valid output mode, expected screen, log, both, own_log or full", mode),
                      overridden ? fields.where() : fields.where("output"),
                      overridden ? "it comes from the environment variable OVERRIDE_LAUNCH_PROCESS_OUTPUT"
                                 : did_you_mean(mode, {"screen", "log", "both", "own_log", "full"}));
  }
  if (overridden) {
    return *routing;
  }
  return {.out = fields.has("stdout") ? targets(fields.text("stdout"), scope) : routing->out,
          .err = fields.has("stderr") ? targets(fields.text("stderr"), scope) : routing->err};
}

Environment environment_of(const Fields& fields, Scope& scope) {
  Environment environment = fields.boolean("clean_env", false).perform(scope) ? Environment() : scope.environment;
  for (const auto& [name, value] : perform_pairs(fields, "env", scope)) {
    environment.insert_or_assign(name, value);
  }
  if (fields.boolean("leave-running", false).perform(scope)) {
    environment.insert_or_assign(kLeaveRunningVariable, "1");
  }
  return environment;
}

void perform_respawn(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const std::string text = fields.text("respawn").perform(scope);
  const std::optional<bool> enabled = yaml_boolean(text);
  if (!enabled) {
    throw LaunchError(fmt::format("respawn is expected to be a boolean, got '{}'", text), fields.where("respawn"),
                      "write true or false");
  }
  spec.respawn.enabled = *enabled;
}

void perform_backoff(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  RespawnPolicy& policy = spec.respawn;
  NumberField factor = *fields.number("respawn_backoff");
  factor.require_not_negative();
  policy.backoff = factor.perform(scope);
  if (policy.backoff < 1.0) {
    throw LaunchError(fmt::format("respawn_backoff is a factor of at least 1, got {}", policy.backoff),
                      fields.where("respawn_backoff"), "2 doubles the delay each time");
  }
  if (policy.enabled && policy.backoff > 1.0 && policy.delay == Duration{0}) {
    throw LaunchError("respawn_backoff can't make a respawn_delay of 0 longer", fields.where("respawn_backoff"),
                      "add respawn_delay, the first delay in seconds", Finding::kExclusive);
  }
}

void perform_start_limit(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  spec.start_limit.starts = static_cast<std::int64_t>(fields.number("start_limit")->perform(scope));
  if (spec.start_limit.starts < 1) {
    throw LaunchError(fmt::format("start_limit must be at least 1, got {}", spec.start_limit.starts),
                      fields.where("start_limit"), "leave it out to have no limit");
  }
}

void perform_on_start_limit(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const std::string given = fields.text("on_start_limit").perform(scope);
  if (given != "none" && given != "shutdown") {
    throw LaunchError(fmt::format("on_start_limit can be none or shutdown, got '{}'", given),
                      fields.where("on_start_limit"), "other actions go into an event handler, <on_start_limit>");
  }
  spec.start_limit.shuts_down = given == "shutdown";
}

void check_start_limit(const Fields& fields) {
  for (const char* const of_limit : {"start_limit_interval", "start_limit_cool_down", "on_start_limit"}) {
    if (fields.has(of_limit) && !fields.has("start_limit")) {
      throw LaunchError(fmt::format("{} goes with start_limit only", of_limit), fields.where(of_limit),
                        "give start_limit, the number of starts", Finding::kExclusive);
    }
  }
}

void perform_required(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  spec.required = fields.boolean("required", false).perform(scope);
  if (spec.required && spec.respawn.enabled) {
    throw LaunchError("a required process can't respawn: its end is the end of the system", fields.where("required"),
                      "leave out required or respawn", Finding::kExclusive);
  }
}

void perform_allowed_exits(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const Template& text = fields.text("allowed-exit-codes");
  const ExitCodeFilter allowed(text.perform(scope), text.where());
  spec.allowed_exits = {!allowed.is_listed(), allowed.codes()};
}

void perform_on_exit(const Fields& fields, Scope&, ProcessSpec& spec) {
  const std::string on_exit = fields.literal("on_exit");
  if (on_exit != "shutdown") {
    throw LaunchError(fmt::format("on_exit can only be 'shutdown', got '{}'", on_exit), fields.where("on_exit"),
                      "to start again write respawn=\"true\"; for other actions on_process_exit");
  }
  spec.shutdown_on_exit = true;
}

using Type = AttributeType;

// A row without a place is read by request_process(), with the context or with what another row doesn't know.
const std::vector<Setting<ProcessSpec>>& process_settings() {
  static const std::vector<Setting<ProcessSpec>> settings = {
      {.attribute = {"cwd", Type::kText, false, "the launcher's", "working directory"},
       .place = place_of(&ProcessSpec::working_directory)},
      {.attribute = {"launch-prefix", Type::kText, false, "configuration launch-prefix",
                     "command line put in front, such as gdb"}},
      {.attribute = {"output", Type::kText, false, "log", "screen, log, both, own_log or full"}},
      {.attribute = {"stdout", Type::kText, false, "as output says",
                     "where standard output goes: screen, log and own_log, several with commas, or none", true}},
      {.attribute = {"stderr", Type::kText, false, "as output says", "where standard error goes; values as for stdout",
                     true}},
      {.attribute = {"respawn", Type::kText, false, "false", "true: start the process again whenever it ends"},
       .perform = perform_respawn},
      {.attribute = {"respawn_delay", Type::kFloat, false, "0", "seconds between an exit and the next start"},
       .place = place_of(&ProcessSpec::respawn, &RespawnPolicy::delay)},
      {.attribute = {"respawn_max_retries", Type::kInteger, false, "-1",
                     "how often to start the process again; negative: no limit"},
       .place = place_of(&ProcessSpec::respawn, &RespawnPolicy::max_retries)},
      {.attribute = {"respawn_backoff", Type::kFloat, false, "1",
                     "factor from one delay to the next; a run longer than respawn_max_delay starts the series anew",
                     true},
       .place = [](ProcessSpec& spec) -> SettingPlace { return NumberFromZero{&spec.respawn.backoff}; },
       .perform = perform_backoff},
      {.attribute = {"respawn_max_delay", Type::kFloat, false, "60", "seconds: the longest delay with respawn_backoff",
                     true},
       .place = place_of(&ProcessSpec::respawn, &RespawnPolicy::max_delay)},
      {.attribute = {"start_limit", Type::kInteger, false, "none",
                     "how often the process may start within start_limit_interval, by respawn or because it is "
                     "unhealthy; then it is given up",
                     true},
       .perform = perform_start_limit},
      {.attribute = {"start_limit_interval", Type::kFloat, false, "60", "seconds in which starts are counted", true},
       .place = place_of(&ProcessSpec::start_limit, &StartLimit::within)},
      {.attribute = {"start_limit_cool_down", Type::kFloat, false, "none",
                     "seconds after which a process that was given up is started again", true},
       .place = place_of(&ProcessSpec::start_limit, &StartLimit::cool_down)},
      {.attribute = {"on_start_limit", Type::kText, false, "none",
                     "shutdown: when the process is given up, the whole system ends", true},
       .perform = perform_on_start_limit,
       .checks_literal = true},
      {.attribute = {"scalable", Type::kBoolean, false, "false",
                     "true: several of it may run side by side, see launch scale", true},
       .place = place_of(&ProcessSpec::scalable)},
      {.attribute = {"required", Type::kBoolean, false, "false",
                     "true: when the process ends, the whole system ends with its exit code", true},
       .perform = perform_required},
      {.attribute = {"allowed-exit-codes", Type::kText, false, "0",
                     "ends that are no failures: any, or codes and signals (2 or SIGTERM) separated by commas; 0 is "
                     "always one",
                     true},
       .perform = perform_allowed_exits},
      {.attribute = {"crash-dir", Type::kText, false, "configuration crash-dir",
                     "directory for bundles: core, backtrace, last output and command of each crash of the process",
                     true},
       .place = place_of(&ProcessSpec::crash_directory)},
      {.attribute = {"on_exit", Type::kLiteral, false, "", "shutdown: when the process ends, the whole system ends"},
       .perform = perform_on_exit,
       .checks_literal = true},
      {.attribute = {"shell", Type::kBoolean, false, "false", "run the words, joined by spaces, through /bin/sh -c"},
       .place = place_of(&ProcessSpec::shell)},
      {.attribute = {"emulate_tty", Type::kBoolean, false, "false", "make standard output and error pseudo-terminals"}},
      {.attribute = {"stdin", Type::kText, false, "none",
                     "terminal: the process reads the terminal of the launch; none: it has nothing to read", true},
       .perform = perform_stdin},
      {.attribute = {"tty", Type::kBoolean, false, "false",
                     "true: standard input, output and error are a terminal of its own, for launch attach", true},
       .perform = perform_tty},
      {.attribute = {"trace", Type::kBoolean, false, "true", "false: no trace records this process", true},
       .place = place_of(&ProcessSpec::traced)},
      {.attribute = {"leave-running", Type::kBoolean, false, "false",
                     "true: what it leaves running in a session of its own, as a daemon has, goes on after the launch",
                     true}},
      {.attribute = {"sigterm_timeout", Type::kFloat, false, "5", "seconds from SIGINT to SIGTERM at shutdown"},
       .place = place_of(&ProcessSpec::sigterm_timeout)},
      {.attribute = {"sigkill_timeout", Type::kFloat, false, "5", "seconds from SIGTERM to SIGKILL at shutdown"},
       .place = place_of(&ProcessSpec::sigkill_timeout)},
      {.attribute = {"clean_env", Type::kBoolean, false, "false", "true: the environment holds the env items only",
                     true}},
  };
  return settings;
}

// A launch configuration of the name of an attribute holds where the attribute is not given.
void perform_configured_timeout(const Fields& fields, const char* name, Scope& scope, Duration& timeout) {
  const std::string* const text = find_configuration(scope, name);
  if (text == nullptr || fields.has(name)) {
    return;
  }
  try {
    NumberField number(Template(*text, fields.where()), false);
    number.require_not_negative();
    timeout = as_duration(number.perform(scope));
  } catch (const LaunchError& error) {
    throw LaunchError(fmt::format("launch configuration '{}': {}", name, error.diagnostics().front().message),
                      fields.where());
  }
}

void perform_configurations(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  const std::string* const crash_directory = find_configuration(scope, "crash-dir");
  if (crash_directory != nullptr && !fields.has("crash-dir")) {
    spec.crash_directory = *crash_directory;
  }
  perform_emulated_terminals(fields, scope, spec);
  perform_configured_timeout(fields, "sigterm_timeout", scope, spec.sigterm_timeout);
  perform_configured_timeout(fields, "sigkill_timeout", scope, spec.sigkill_timeout);
}

void find_missing_directory(const std::string& directory, const SourceRange& where, LaunchContext& context) {
  std::error_code ignored;
  if (!directory.empty() && !std::filesystem::is_directory(directory, ignored)) {
    context.exploration().remark(
        {Severity::kError, fmt::format("the working directory '{}' does not exist", directory), where,
         directory.starts_with('/') ? "" : "a relative path is relative to the launcher's working directory",
         Finding::kMissingDirectory});
  }
}

}  // namespace

std::vector<AttributeSpec> with_process_attributes(std::vector<AttributeSpec> own) {
  std::ranges::move(declared_attributes(process_settings()), std::back_inserter(own));
  std::ranges::move(declared_attributes(resource_settings()), std::back_inserter(own));
  std::ranges::move(declared_attributes(control_group_settings()), std::back_inserter(own));
  return own;
}

std::vector<ItemSpec> process_items() {
  return {pair_item("env", "a variable of the process's environment", "name of the variable"), DependsOn::item(),
          WatchItem::item()};
}

void check_process(const Fields& fields) {
  check_start_limit(fields);
  check_settings(process_settings(), fields);
  check_settings(resource_settings(), fields);
  check_settings(control_group_settings(), fields);
  for (const Fields* dependency : fields.items("depends_on")) {
    (void)DependsOn(*dependency);
  }
  for (const Fields* watch : fields.items("watch")) {
    WatchItem::check(*watch);
  }
}

void request_process(const Fields& fields, LaunchContext& context, ProcessSpec spec) {
  Scope& scope = context.scope();
  std::vector<std::string> prefix = launch_prefix(fields, scope, spec.argv.front());
  for (GeneratedFile& file : spec.files) {
    file.argument += prefix.size();
  }
  spec.argv.insert(spec.argv.begin(), prefix.begin(), prefix.end());
  if (spec.name.empty()) {
    spec.name = std::filesystem::path(spec.argv.front()).filename().string();
  }
  spec.name = without_control_characters(std::move(spec.name));

  spec.environment = environment_of(fields, scope);
  perform_settings(resource_settings(), fields, scope, spec.limits);
  perform_settings(control_group_settings(), fields, scope, spec.control_limits);
  check_resources(fields, spec.limits);
  spec.control_groups = scope.control_groups;
  if (scope.machine == nullptr) {
    find_faults_of_cpus(spec.limits.cpus, fields.where("cpus"), context);
  }
  spec.output = output(fields, context);
  perform_settings(process_settings(), fields, scope, spec);
  perform_configurations(fields, scope, spec);
  if (fields.has("cwd") && scope.machine == nullptr) {
    find_missing_directory(spec.working_directory, fields.where("cwd"), context);
  }
  if (!spec.crash_directory.empty()) {
    spec.crash_directory = std::filesystem::absolute(spec.crash_directory).string();
  }
  spec.limits.core_files = !spec.crash_directory.empty();
  spec.origin = fields.where();
  spec.groups = scope.groups;
  for (const Fields* watch : fields.items("watch")) {
    WatchItem::perform(*watch, context, spec);
  }
  put_on_machine(fields, context, spec);
  for (const Fields* dependency : fields.items("depends_on")) {
    DependsOn(*dependency).request(context, context.requests().processes.size());
  }
  context.requests().processes.push_back(std::move(spec));
}

}  // namespace launch
