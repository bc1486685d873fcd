// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/deployment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <variant>

#include "base/overloaded.hpp"
#include "base/processes/process_mark.hpp"
#include "launcher/deploy/shell_variables.hpp"
#include "launcher/deploy/systemd_text.hpp"
#include "launcher/plan/dry_run.hpp"

namespace launch {
namespace {

constexpr std::size_t kLongestWord = 150;  // of 255 for a file: a name of the whole and a number come to it

// As shells and systemd have them.
bool is_variable_name(const std::string& name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

class Collector {
 public:
  explicit Collector(const LaunchPlan& plan) : plan_(plan) {}

  DeploymentPlan collect() {
    std::map<std::string, std::size_t> count;
    for (std::size_t i = 0; i < plan_.processes.size(); ++i) {
      const ProcessSpec& spec = plan_.processes[i];
      const std::size_t number = ++count[spec.name];
      const std::string name = number == 1 ? spec.name : fmt::format("{}-{}", spec.name, number);
      result_.services.push_back({.name = name,
                                  .word = word_of(name),
                                  .spec = &spec,
                                  .delay = i < plan_.delays.size() ? plan_.delays[i] : Duration{0},
                                  .files = {},
                                  .before = {}});
      name_files(result_.services.back());
      add_what_no_service_has(spec);
    }
    for (const Dependency& dependency : plan_.dependencies) {
      add_dependency(dependency);
    }
    add_requests();
    return std::move(result_);
  }

 private:
  void leave_out(std::string what, const SourceRange& where) { result_.left_out.push_back({std::move(what), where}); }

  void add_what_no_service_has(const ProcessSpec& spec) {
    if (!spec.machine.empty()) {
      add_what_nobody_knows(spec);
    }
    if (spec.tty || spec.terminal_input) {
      leave_out(fmt::format("the terminal of '{}'", spec.name), spec.origin);
    }
    if (!spec.crash_directory.empty()) {
      leave_out(fmt::format("the crash directory of '{}'", spec.name), spec.origin);
    }
    if (spec.start_limit.starts > 0 && spec.start_limit.cool_down) {
      leave_out(fmt::format("the pause of '{}' after too many starts", spec.name), spec.origin);
    }
    if (spec.start_limit.starts > 0 && spec.start_limit.shuts_down) {
      leave_out(fmt::format("the end of all after too many starts of '{}'", spec.name), spec.origin);
    }
    if (spec.environment.contains(kLeaveRunningVariable)) {
      leave_out(fmt::format("what '{}' leaves running", spec.name), spec.origin);
    }
    for (const auto& [name, value] : spec.environment) {
      if (!is_variable_name(name)) {
        leave_out(fmt::format("the variable '{}' of '{}'", name, spec.name), spec.origin);
      }
    }
    if (spec.scalable) {
      leave_out(fmt::format("further copies of '{}'", spec.name), spec.origin);
    }
  }

  // A plan that has asked no machine has texts in angle brackets.
  void add_what_nobody_knows(const ProcessSpec& spec) {
    const std::string end = fmt::format(" on {}>", spec.machine);
    const auto look = [&](const std::string& text, const std::string& what) {
      const std::size_t last = text.find(end);
      const std::size_t first = last == std::string::npos ? last : text.rfind('<', last);
      if (first != std::string::npos) {
        leave_out(fmt::format("{} of '{}', for nobody has asked the machine: {}", what, spec.name,
                              text.substr(first, last + end.size() - first)),
                  spec.origin);
      }
    };
    for (std::size_t i = 0; i < spec.argv.size(); ++i) {
      look(spec.argv[i], i == 0 ? "the program" : fmt::format("argument {}", i));
    }
    for (const auto& [name, value] : spec.environment) {
      look(value, fmt::format("the variable '{}'", name));
    }
    for (const GeneratedFile& file : spec.files) {
      look(file.content, "a parameter file");
    }
    look(spec.working_directory, "the working directory");
  }

  // Two names may become one word; then the second one gets a number.
  std::string word_of(const std::string& name) {
    std::string word = unit_name(name).substr(0, kLongestWord);
    std::replace(word.begin(), word.end(), ':', '-');
    if (word.empty() || word.front() == '.') {
      word.insert(0, "-");
    }
    return unused(word, "", words_);
  }

  static std::string unused(const std::string& text, const std::string& end, std::set<std::string>& used) {
    std::string chosen = text + end;
    for (int number = 2; !used.insert(chosen).second; ++number) {
      chosen = fmt::format("{}-{}{}", text, number, end);
    }
    return chosen;
  }

  void name_files(Service& service) {
    for (std::size_t i = 0; i < service.spec->files.size(); ++i) {
      const std::string text = i == 0 ? service.word : fmt::format("{}.{}", service.word, i + 1);
      service.files.push_back(unused(text, ".yaml", files_));
    }
  }

  std::optional<std::size_t> service_named(const std::string& name) const {
    for (std::size_t i = 0; i < plan_.processes.size(); ++i) {
      const ProcessSpec& spec = plan_.processes[i];
      if (spec.name == name || fmt::format("{}-{}", spec.name, i + 1) == name ||
          std::find(spec.other_names.begin(), spec.other_names.end(), name) != spec.other_names.end()) {
        return i;
      }
    }
    return std::nullopt;
  }

  void add_dependency(const Dependency& dependency) {
    Service& service = result_.services[dependency.process];
    const std::string waits = fmt::format("'{}' waits until {}", service.name, describe(dependency));
    const auto* const process = std::get_if<ProcessCondition>(&dependency.condition);
    const std::optional<std::size_t> other = process == nullptr ? std::nullopt : service_named(process->process);
    if (!other) {
      leave_out(waits, dependency.where);
      return;
    }
    ServiceBefore before{.service = *other,
                         .wanted = dependency.on_failure == OnFailure::kStart,
                         .ends_all = dependency.on_failure == OnFailure::kShutdown,
                         .waits = waits,
                         .where = dependency.where};
    const auto* const exited = std::get_if<UntilExited>(&process->state);
    if (exited != nullptr) {
      before.ended = true;
      before.succeeded = exited->exit_code.is_listed() && exited->exit_code.codes() == std::vector<int>{0};
      if (!before.succeeded && exited->exit_code.text() != "any") {
        leave_out(waits + ", with this code", dependency.where);
      }
      if (result_.services[*other].spec->respawn.enabled) {
        leave_out(waits + ": it starts again when it has ended", dependency.where);
        return;
      }
    } else if (std::holds_alternative<UntilHealthy>(process->state)) {
      before.healthy = true;
    } else if (!std::holds_alternative<UntilStarted>(process->state)) {
      leave_out(waits + "; the start is what is waited for", dependency.where);
    }
    if (dependency.timeout) {
      leave_out(fmt::format("'{}' waits at most {} s", service.name,
                            std::chrono::duration<double>(*dependency.timeout).count()),
                dependency.where);
    }
    service.before.push_back(before);
  }

  void add_requests() {
    for_each_request(
        plan_, Overloaded{
                   [&](const RunScopePtr& scope) { leave_out(fmt::format("the {}", scope->kind()), scope->origin()); },
                   [&](const EventHandler& handler) { leave_out(describe(handler), handler.where); },
                   [&](const LoadRequest& request) {
                     for (const ComposableNode& node : request.nodes) {
                       leave_out(fmt::format("{} {} is loaded into {}", node.package, node.plugin, request.target),
                                 node.origin);
                     }
                   },
                   [&](const TransitionRequest& request) {
                     leave_out(fmt::format("the states of {}: {}", request.node, fmt::join(request.transitions, ", ")),
                               request.origin);
                   },
                   [&](const CoroutineRequest& request) { leave_out("a coroutine", request.where); },
                   [&](const ProcessCommand& command) {
                     leave_out(fmt::format("the {} of '{}'", name_of(command.kind), command.process), command.where);
                   },
                   [&](const ShutdownRequest& request) {
                     leave_out(fmt::format("the end of all that the file asks for: {}", request.reason), request.where);
                   },
                   PassOver<TestRequest, ProcessSpec, UnregisterRequest, TimerRequest, NodeDescription, Dependency>(),
               });
    for (const LeftToRun& left : plan_.left_to_run) {
      leave_out(left.function.empty() ? "an action that depends on functions of the file"
                                      : fmt::format("what the function {} gives", left.function),
                left.where);
    }
  }

  const LaunchPlan& plan_;
  std::set<std::string> words_;
  std::set<std::string> files_;
  DeploymentPlan result_;
};

}  // namespace

std::string export_mark(const DeploymentOptions& options) {
  const std::string machine = options.machine.empty() ? "" : fmt::format(" for machine '{}'", options.machine);
  return fmt::format("# Made by 'launch export {}' with the name '{}'{}, which may make it anew.", options.kind,
                     options.name, machine);
}

DeploymentPlan deployment_of(const LaunchPlan& plan) {
  return Collector(plan).collect();
}

std::vector<std::string> command_line_of(const ProcessSpec& spec, const std::vector<std::string>& paths_of_files) {
  std::vector<std::string> words = spec.argv;
  for (std::size_t i = 0; i < spec.files.size(); ++i) {
    words[spec.files[i].argument] = paths_of_files[i];
  }
  if (!spec.shell) {
    return words;
  }
  return {"/bin/sh", "-c", fmt::format("{}", fmt::join(words, " "))};
}

std::string seconds_text(Duration time) {
  std::string text = fmt::format("{:.9f}", std::chrono::duration<double>(time).count());
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) {
    text.pop_back();
  }
  return text;
}

Duration stop_timeout_of(const ProcessSpec& spec) {
  return std::max<Duration>(spec.sigterm_timeout + spec.sigkill_timeout, std::chrono::milliseconds(1));
}

const Environment& shell_of(const ProcessSpec& spec, const DeploymentOptions& options) {
  const auto found = options.shells_elsewhere.find(spec.machine);
  return spec.machine.empty() || found == options.shells_elsewhere.end() ? options.shell : found->second;
}

ServiceVariables variables_of(const ProcessSpec& spec, const Environment& shell, ShellVariables of_shell) {
  ServiceVariables result;
  const auto changes = environment_difference(spec.environment, shell);
  for (const auto& [name, value] : spec.environment) {
    if (!is_variable_name(name) || name == kLeaveRunningVariable) {
      continue;
    }
    const bool is_taken = is_setting_variable(name) || (of_shell == ShellVariables::kAll && is_path_variable(name));
    if (is_taken || changes.contains(name)) {
      result.set.emplace_back(name, value);
    }
  }
  for (const auto& [name, value] : changes) {
    if (!value && is_variable_name(name)) {
      result.removed.push_back(name);
    }
  }
  return result;
}

}  // namespace launch
