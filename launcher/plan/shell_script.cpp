// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "base/overloaded.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/plan/dry_run.hpp"

namespace launch {

namespace {

// `files` counts the generated files of all processes.
std::string process_as_script(const ProcessSpec& spec, const Environment& launcher_environment, std::size_t& files) {
  std::string text = fmt::format("\n# {}, {}\n", spec.name, to_string(spec.origin));
  std::vector<std::string> words;
  for (const std::string& word : spec.argv) {
    words.push_back(spec.shell ? word : shell_quoted(word));
  }
  for (const GeneratedFile& file : spec.files) {
    const std::string name = fmt::format("{}-{}", ++files, file.name);
    const bool ends_line = !file.content.empty() && file.content.back() == '\n';
    text += fmt::format("cat > \"$parameters\"/{} <<'END_OF_FILE'\n{}{}END_OF_FILE\n", shell_quoted(name), file.content,
                        ends_line ? "" : "\n");
    words[file.argument] = "\"$parameters\"/" + shell_quoted(name);
  }
  std::string unset;  // env(1) takes these first
  std::string set;
  for (const auto& [name, value] : environment_difference(spec.environment, launcher_environment)) {
    (value ? set : unset) += value ? fmt::format(" {}={}", name, shell_quoted(*value)) : fmt::format(" -u {}", name);
  }
  const std::string change = unset + set;
  std::string command = fmt::format("{}", fmt::join(words, " "));
  if (spec.shell) {
    command = "/bin/sh -c " + shell_quoted(command);
  }
  return text + fmt::format("({}exec {}{}) &\n",
                            spec.working_directory.empty()
                                ? ""
                                : fmt::format("cd {} && ", shell_quoted(spec.working_directory)),
                            change.empty() ? "" : "env" + change + " ", command);
}

// What the launch does about the process and the script does not.
std::string remarks_on(const ProcessSpec& spec, Duration delay) {
  std::string text;
  if (delay > Duration(0)) {
    text += fmt::format("# the launch starts it after {} s\n", std::chrono::duration<double>(delay).count());
  }
  text += spec.respawn.enabled ? "# the launch starts it again when it has ended\n" : "";
  text += spec.required ? "# the launch ends with it\n" : "";
  return text;
}

}  // namespace

std::string plan_as_shell_script(const LaunchPlan& plan, const Environment& launcher_environment) {
  std::string traces;
  std::vector<std::string> processes;
  std::vector<std::string> remarks;  // on each of them
  std::string components;
  std::string handlers;
  std::size_t files = 0;
  for_each_request(
      plan, Overloaded{
                [&](const RunScopePtr& scope) {
                  traces += fmt::format("# not started: the {} of {}\n", scope->kind(), to_string(scope->origin()));
                },
                [&](const EventHandler& handler) {
                  handlers += fmt::format("\n# not watched for: {}, {}\n", describe(handler), to_string(handler.where));
                },
                [&](const LoadRequest& request) {
                  for (const ComposableNode& node : request.nodes) {
                    components += fmt::format("\n# not loaded: {} {} into {}, {}\n", node.package, node.plugin,
                                              request.target, to_string(node.origin));
                  }
                },
                [&](const ProcessSpec& spec) {
                  remarks.push_back(remarks_on(spec, plan.delays[processes.size()]));
                  processes.push_back(spec.machine.empty()
                                          ? process_as_script(spec, launcher_environment, files)
                                          : fmt::format("\n# not started: {} on machine {}, {}\n", spec.name,
                                                        spec.machine, to_string(spec.origin)));
                },
                [&](const Dependency& dependency) {
                  remarks[dependency.process] += fmt::format("# the launch waits until {}\n", describe(dependency));
                },
                PassOver<ProcessCommand, UnregisterRequest, TestRequest, TimerRequest, TransitionRequest,
                         CoroutineRequest, ShutdownRequest, NodeDescription>(),
            });
  // A shell starts what is in the background with SIGINT ignored, so the trap sends SIGTERM.
  std::string text =
      "#!/bin/sh\n# What the launch would run, at once, without traces and supervision. Ctrl-C ends all of it.\n"
      "trap 'trap \"\" TERM; kill 0; wait; exit 130' INT TERM\n";
  text += traces;
  if (files > 0) {
    text += "parameters=$(mktemp -d) || exit 1\nexport parameters\ntrap 'rm -rf \"$parameters\"' EXIT\n";
  }
  for (std::size_t i = 0; i < processes.size(); ++i) {
    const std::size_t end_of_title = processes[i].find('\n', 1) + 1;
    text += processes[i].insert(end_of_title, remarks[i]);
  }
  text += components;
  for (const LeftToRun& left : plan.left_to_run) {
    text += fmt::format("\n# not known without a run: {}, {}\n",
                        left.function.empty() ? "an action" : "function " + left.function, to_string(left.where));
  }
  return text + handlers + "\nwait\n";
}

std::map<std::string, std::optional<std::string>> environment_difference(const Environment& of, const Environment& to) {
  std::map<std::string, std::optional<std::string>> changes;
  for (const auto& [name, value] : of) {
    const auto own = to.find(name);
    if (own == to.end() || own->second != value) {
      changes.emplace(name, value);
    }
  }
  for (const auto& [name, value] : to) {
    if (!of.contains(name)) {
      changes.emplace(name, std::nullopt);
    }
  }
  return changes;
}

std::map<std::string, std::optional<std::string>> shown_changes(const ProcessSpec& spec,
                                                                const Environment& launcher_environment) {
  return environment_difference(spec.environment, spec.machine.empty() ? launcher_environment : Environment());
}

}  // namespace launch
