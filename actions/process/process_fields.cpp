// SPDX-License-Identifier: Apache-2.0
#include "actions/process/process_fields.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <regex>

#include "actions/process/process_findings.hpp"
#include "base/processes/process_mark.hpp"
#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

Duration seconds(double value) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(value));
}

std::optional<NumberField> not_negative(std::optional<NumberField> field) {
  if (field) {
    field->require_not_negative();
  }
  return field;
}

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

}  // namespace

std::vector<AttributeSpec> ProcessFields::attributes() {
  std::vector<AttributeSpec> attributes = {
      {"cwd", AttributeType::kText, false, "the launcher's", "working directory"},
      {"launch-prefix", AttributeType::kText, false, "configuration launch-prefix",
       "command line put in front, such as gdb"},
      {"output", AttributeType::kText, false, "log", "screen, log, both, own_log or full"},
      {"stdout", AttributeType::kText, false, "as output says",
       "where standard output goes: screen, log and own_log, several with commas, or none", true},
      {"stderr", AttributeType::kText, false, "as output says", "where standard error goes; values as for stdout",
       true},
      {"respawn", AttributeType::kText, false, "false", "true: start the process again whenever it ends"},
      {"respawn_delay", AttributeType::kFloat, false, "0", "seconds between an exit and the next start"},
      {"respawn_max_retries", AttributeType::kInteger, false, "-1",
       "how often to start the process again; negative: no limit"},
      {"respawn_backoff", AttributeType::kFloat, false, "1",
       "factor from one delay to the next; a run longer than respawn_max_delay starts the series anew", true},
      {"respawn_max_delay", AttributeType::kFloat, false, "60", "seconds: the longest delay with respawn_backoff",
       true},
      {"required", AttributeType::kBoolean, false, "false",
       "true: when the process ends, the whole system ends with its exit code", true},
      {"allowed-exit-codes", AttributeType::kText, false, "0",
       "ends that are no failures: any, or codes and signals (2 or SIGTERM) separated by commas; 0 is always one",
       true},
      {"crash-dir", AttributeType::kText, false, "configuration crash-dir",
       "directory for bundles: core, backtrace, last output and command of each crash of the process", true},
      {"on_exit", AttributeType::kLiteral, false, "", "shutdown: when the process ends, the whole system ends"},
      {"shell", AttributeType::kBoolean, false, "false", "run the words, joined by spaces, through /bin/sh -c"},
      {"emulate_tty", AttributeType::kBoolean, false, "false", "make standard output and error pseudo-terminals"},
      {"stdin", AttributeType::kText, false, "none",
       "terminal: the process reads the terminal of the launch; none: it has nothing to read", true},
      {.name = "trace",
       .type = AttributeType::kBoolean,
       .default_value = "true",
       .help = "false: no trace records this process",
       .extension = true},
      {.name = "leave-running",
       .type = AttributeType::kBoolean,
       .default_value = "false",
       .help = "true: what it leaves running in a session of its own, as a daemon has, goes on after the launch",
       .extension = true},
      {"sigterm_timeout", AttributeType::kFloat, false, "5", "seconds from SIGINT to SIGTERM at shutdown"},
      {"sigkill_timeout", AttributeType::kFloat, false, "5", "seconds from SIGTERM to SIGKILL at shutdown"},
      {"clean_env", AttributeType::kBoolean, false, "false", "true: the environment holds the env items only", true},
  };
  const std::vector<AttributeSpec> resources = ResourceFields::attributes();
  attributes.insert(attributes.end(), resources.begin(), resources.end());
  return attributes;
}

std::vector<ItemSpec> ProcessFields::items() {
  return {{"env",
           "a variable of the process's environment",
           {{"name", AttributeType::kText, true, "", "name of the variable"},
            {"value", AttributeType::kText, true, "", "its value"}}},
          DependsOn::item()};
}

ProcessFields::ProcessFields(const Fields& fields)
    : where_(fields.where()),
      working_directory_(fields.optional_text("cwd")),
      launch_prefix_(fields.optional_text("launch-prefix")),
      output_(fields.optional_text("output")),
      stdout_(fields.optional_text("stdout")),
      stderr_(fields.optional_text("stderr")),
      respawn_(fields.optional_text("respawn")),
      respawn_delay_(not_negative(fields.number("respawn_delay"))),
      respawn_max_retries_(fields.number("respawn_max_retries")),
      respawn_backoff_(not_negative(fields.number("respawn_backoff"))),
      respawn_max_delay_(not_negative(fields.number("respawn_max_delay"))),
      respawn_backoff_where_(fields.where("respawn_backoff")),
      allowed_exits_(fields.optional_text("allowed-exit-codes")),
      crash_directory_(fields.optional_text("crash-dir")),
      required_(fields.boolean("required", false)),
      required_where_(fields.where("required")),
      shell_(fields.boolean("shell", false)),
      emulate_tty_(fields.boolean("emulate_tty", false)),
      stdin_(fields.optional_text("stdin")),
      traced_(fields.boolean("trace", true)),
      leave_running_(fields.boolean("leave-running", false)),
      sigterm_timeout_(not_negative(fields.number("sigterm_timeout"))),
      sigkill_timeout_(not_negative(fields.number("sigkill_timeout"))),
      clean_environment_(fields.boolean("clean_env", false)),
      resources_(fields) {
  if (fields.has("on_exit")) {
    const std::string on_exit = fields.literal("on_exit");
    if (on_exit != "shutdown") {
      throw LaunchError(fmt::format("on_exit can only be 'shutdown', got '{}'", on_exit), fields.where("on_exit"),
                        "to start again write respawn=\"true\"; for other actions on_process_exit");
    }
    shutdown_on_exit_ = true;
  }
  for (const Fields* variable : fields.items("env")) {
    environment_.emplace_back(variable->text("name"), variable->text("value"));
  }
  for (const Fields* dependency : fields.items("depends_on")) {
    dependencies_.emplace_back(*dependency);
  }
}

void ProcessFields::request(LaunchContext& context, ProcessSpec spec) const {
  Scope& scope = context.scope();
  std::vector<std::string> prefix = launch_prefix(scope, spec.argv.front());
  for (GeneratedFile& file : spec.files) {
    file.argument += prefix.size();
  }
  spec.argv.insert(spec.argv.begin(), prefix.begin(), prefix.end());
  if (spec.name.empty()) {
    spec.name = std::filesystem::path(spec.argv.front()).filename().string();
  }

  spec.environment = environment(scope);
  spec.limits = resources_.perform(scope);
  find_missing_cpus(spec.limits.cpus, resources_.where_of_cpus(), context);
  if (working_directory_) {
    spec.working_directory = working_directory_->perform(scope);
    find_missing_directory(spec.working_directory, working_directory_->where(), context);
  }
  spec.output = output(context);
  spec.traced = traced_.perform(scope);
  spec.respawn = respawn(scope);
  if (allowed_exits_) {
    const ExitCodeFilter allowed(allowed_exits_->perform(scope), allowed_exits_->where());
    spec.allowed_exits = {!allowed.is_listed(), allowed.codes()};
  }
  spec.crash_directory = crash_directory(scope);
  spec.limits.core_files = !spec.crash_directory.empty();
  spec.required = required_.perform(scope);
  if (spec.required && spec.respawn.enabled) {
    throw LaunchError("a required process can't respawn: its end is the end of the system", required_where_,
                      "leave out required or respawn", Finding::kExclusive);
  }
  spec.shutdown_on_exit = shutdown_on_exit_;
  spec.shell = shell_.perform(scope);
  spec.emulate_tty = emulate_tty(scope);
  spec.terminal_input = terminal_input(scope);
  spec.sigterm_timeout = timeout(scope, sigterm_timeout_, "sigterm_timeout");
  spec.sigkill_timeout = timeout(scope, sigkill_timeout_, "sigkill_timeout");
  spec.origin = where_;
  for (const DependsOn& dependency : dependencies_) {
    dependency.request(context, context.requests().processes.size());
  }
  context.requests().processes.push_back(std::move(spec));
}

std::string ProcessFields::crash_directory(Scope& scope) const {
  const std::string* const configured = find_configuration(scope, "crash-dir");
  const std::string directory = crash_directory_        ? crash_directory_->perform(scope)
                                : configured != nullptr ? *configured
                                                        : "";
  return directory.empty() ? "" : std::filesystem::absolute(directory).string();
}

Environment ProcessFields::environment(Scope& scope) const {
  Environment environment = clean_environment_.perform(scope) ? Environment() : scope.environment;
  for (const auto& [name, value] : environment_) {
    environment.insert_or_assign(name.perform(scope), value.perform(scope));
  }
  if (leave_running_.perform(scope)) {
    environment.insert_or_assign(kLeaveRunningVariable, "1");
  }
  return environment;
}

RespawnPolicy ProcessFields::respawn(Scope& scope) const {
  RespawnPolicy policy;
  if (respawn_) {
    const std::string text = respawn_->perform(scope);
    const std::optional<bool> enabled = yaml_boolean(text);
    if (!enabled) {
      throw LaunchError(fmt::format("respawn is expected to be a boolean, got '{}'", text), respawn_->where(),
                        "write true or false");
    }
    policy.enabled = *enabled;
  }
  if (respawn_delay_) {
    policy.delay = seconds(respawn_delay_->perform(scope));
  }
  if (respawn_max_retries_) {
    policy.max_retries = static_cast<std::int64_t>(respawn_max_retries_->perform(scope));
  }
  if (respawn_max_delay_) {
    policy.max_delay = seconds(respawn_max_delay_->perform(scope));
  }
  if (respawn_backoff_) {
    policy.backoff = respawn_backoff_->perform(scope);
    if (policy.backoff < 1.0) {
      throw LaunchError(fmt::format("respawn_backoff is a factor of at least 1, got {}", policy.backoff),
                        respawn_backoff_where_, "2 doubles the delay each time");
    }
    if (policy.enabled && policy.backoff > 1.0 && policy.delay == Duration{0}) {
      throw LaunchError("respawn_backoff can't make a respawn_delay of 0 longer", respawn_backoff_where_,
                        "add respawn_delay, the first delay in seconds", Finding::kExclusive);
    }
  }
  return policy;
}

std::vector<std::string> ProcessFields::launch_prefix(Scope& scope, const std::string& program) const {
  if (launch_prefix_) {
    return split_shell_words(launch_prefix_->perform(scope), launch_prefix_->where());
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
                        where_);
    }
  }
  return split_shell_words(*prefix, where_);
}

OutputRouting ProcessFields::output(LaunchContext& context) const {
  const Environment& environment = context.initial_environment();
  const auto variable = environment.find("OVERRIDE_LAUNCH_PROCESS_OUTPUT");
  const std::string everywhere = !context.wishes().process_output.empty() ? context.wishes().process_output
                                 : variable != environment.end()          ? variable->second
                                                                          : "";
  const bool overridden = !everywhere.empty();
  const std::string mode = overridden ? everywhere : output_ ? output_->perform(context.scope()) : std::string("log");
  const std::optional<OutputRouting> routing = OutputRouting::from_mode(mode);
  if (!routing) {
    throw LaunchError(fmt::format("'{}' is not a valid output mode, expected screen, log, both, own_log or full", mode),
                      output_ && !overridden ? output_->where() : where_,
                      overridden ? "it comes from the environment variable OVERRIDE_LAUNCH_PROCESS_OUTPUT"
                                 : did_you_mean(mode, {"screen", "log", "both", "own_log", "full"}));
  }
  if (overridden) {
    return *routing;
  }
  return {.out = stdout_ ? targets(*stdout_, context.scope()) : routing->out,
          .err = stderr_ ? targets(*stderr_, context.scope()) : routing->err};
}

bool ProcessFields::emulate_tty(Scope& scope) const {
  if (const std::string* const configuration = find_configuration(scope, "emulate_tty")) {
    const std::optional<bool> value = condition_boolean(*configuration);
    if (!value) {
      throw LaunchError(
          fmt::format("launch configuration 'emulate_tty' is expected to be true or false, got '{}'", *configuration),
          where_);
    }
    return *value;
  }
  return emulate_tty_.perform(scope);
}

bool ProcessFields::terminal_input(Scope& scope) const {
  const std::string text = stdin_ ? stdin_->perform(scope) : std::string("none");
  if (text != "terminal" && text != "none") {
    throw LaunchError(fmt::format("'{}' is no standard input, expected terminal or none", text), stdin_->where(),
                      did_you_mean(text, {"terminal", "none"}));
  }
  return text == "terminal";
}

Duration ProcessFields::timeout(Scope& scope, const std::optional<NumberField>& given,
                                const std::string& configuration) const {
  if (given) {
    return seconds(given->perform(scope));
  }
  if (const std::string* const text = find_configuration(scope, configuration)) {
    try {
      NumberField number(Template(*text, where_), false);
      number.require_not_negative();
      return seconds(number.perform(scope));
    } catch (const LaunchError& error) {
      throw LaunchError(
          fmt::format("launch configuration '{}': {}", configuration, error.diagnostics().front().message), where_);
    }
  }
  return ProcessSpec().sigterm_timeout;
}

}  // namespace launch
