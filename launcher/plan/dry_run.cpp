// SPDX-License-Identifier: Apache-2.0
#include "launcher/plan/dry_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/overloaded.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/plan/parameter_json.hpp"

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

// The argv of a process with "@params:N" for the path of its generated file N.
std::vector<std::string> plain_argv(const ProcessSpec& spec) {
  std::vector<std::string> argv = spec.argv;
  for (std::size_t i = 0; i < spec.files.size(); ++i) {
    argv[spec.files[i].argument] = fmt::format("@params:{}", i);
  }
  return argv;
}

Json source_as_json(const SourceRange& where) {
  return {{"file", where.file->path()}, {"line", where.file->position(where.begin).line}};
}

template <typename Text>
Json or_null(const std::optional<Text>& text) {
  return text ? Json(*text) : Json(nullptr);
}

Json process_as_json(const ProcessSpec& spec, const Environment& launcher_environment) {
  Json process;
  process["name"] = spec.name;
  if (!spec.machine.empty()) {
    process["machine"] = spec.machine;
  }
  process["argv"] = plain_argv(spec);
  process["cwd"] = spec.working_directory.empty() ? Json(nullptr) : Json(spec.working_directory);
  Json environment = Json::object();
  for (const auto& [name, value] : shown_changes(spec, launcher_environment)) {
    environment[name] = or_null(value);
  }
  process["env"] = std::move(environment);
  process["shell"] = spec.shell;
  if (spec.terminal_input) {
    process["stdin"] = "terminal";
  }
  if (!spec.files.empty()) {
    Json contents = Json::array();
    for (const GeneratedFile& file : spec.files) {
      contents.push_back(parameter_file_as_json(file.content));
    }
    process["params"] = std::move(contents);
  }
  if (const std::vector<std::string> limits = limits_of(spec); !limits.empty()) {
    process["limits"] = limits;
  }
  for (const HealthWatch& watch : spec.watches) {
    process["watches"].push_back(describe(watch));
  }
  if (spec.origin) {
    process["source"] = source_as_json(spec.origin);
  }
  return process;
}

Json load_request_as_json(const LoadRequest& request) {
  const auto named = [](const std::vector<NamedParameter>& parameters) {
    Json list = Json::array();
    for (const NamedParameter& parameter : parameters) {
      list.push_back({parameter.name, parameter_type_name(parameter.value), parameter_as_json(parameter.value)});
    }
    return list;
  };
  Json nodes = Json::array();
  for (const ComposableNode& component : request.nodes) {
    Json node;
    node["package"] = component.package;
    node["plugin"] = component.plugin;
    node["name"] = component.name;
    node["namespace"] = component.name_space;
    node["parameters"] = named(component.parameters);
    Json remaps = Json::array();
    for (const auto& [from, to] : component.remaps) {
      remaps.push_back(from + ":=" + to);
    }
    node["remaps"] = std::move(remaps);
    node["extra_arguments"] = named(component.extra_arguments);
    if (component.autostart) {
      node["autostart"] = true;
    }
    nodes.push_back(std::move(node));
  }
  return {{"target", request.target}, {"nodes", std::move(nodes)}};
}

std::string indented(const std::string& text, std::size_t width) {
  std::string result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end != begin) {
      result.append(width, ' ').append(text, begin, end - begin);
    }
    result += '\n';
    begin = end + 1;
  }
  return result;
}

std::string counted(std::size_t count, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

std::string dependency_as_text(const Dependency& dependency) {
  std::string text = fmt::format("waits until {}", describe(dependency));
  if (dependency.timeout) {
    text += fmt::format(", at most {} s", std::chrono::duration<double>(*dependency.timeout).count());
  }
  return fmt::format("{}; else {}", text, to_string(dependency.on_failure));
}

std::string scope_as_text(const RunScope& scope) {
  std::string text = fmt::format("{} ({})\n", scope.kind(), to_string(scope.origin()));
  for (const ShownSetting& setting : scope.describe()) {
    const std::string value = std::visit(
        [](const auto& held) {
          using Held = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<Held, std::vector<std::string>>) {
            return fmt::format("{}", fmt::join(held, " "));
          } else {
            return fmt::format("{}", held);
          }
        },
        setting.value);
    text += fmt::format("  {}: {}\n", setting.name, value);
  }
  return text;
}

std::string process_as_text(const ProcessSpec& spec, const Environment& launcher_environment) {
  std::string command;
  for (const std::string& word : plain_argv(spec)) {
    command += (command.empty() ? "" : " ") + (spec.shell ? word : shell_quoted(word));
  }
  std::string text = fmt::format("{} ({})\n  {}\n", spec.name, to_string(spec.origin), command);
  text += spec.machine.empty() ? std::string() : fmt::format("  machine: {}\n", spec.machine);
  if (!spec.working_directory.empty()) {
    text += fmt::format("  cwd: {}\n", spec.working_directory);
  }
  for (const auto& [name, value] : shown_changes(spec, launcher_environment)) {
    text +=
        value ? fmt::format("  env: {}={}\n", name, shell_quoted(*value)) : fmt::format("  env: {} removed\n", name);
  }
  if (spec.terminal_input) {
    text += "  stdin: terminal\n";
  }
  for (const std::string& limit : limits_of(spec)) {
    text += fmt::format("  limit: {}\n", limit);
  }
  for (const HealthWatch& watch : spec.watches) {
    text += fmt::format("  healthy while {}\n", describe(watch));
  }
  for (std::size_t i = 0; i < spec.files.size(); ++i) {
    text += fmt::format("  @params:{}:\n{}", i, indented(spec.files[i].content, 6));
  }
  return text;
}

std::string load_request_as_text(const LoadRequest& request) {
  std::string text = fmt::format("load into {} ({})\n", request.target, to_string(request.origin));
  for (const ComposableNode& node : request.nodes) {
    text += fmt::format("  {} {} as {}\n", node.package, node.plugin,
                        node.name_space.empty() ? node.name : node.name_space + "/" + node.name);
    for (const NamedParameter& parameter : node.parameters) {
      text += fmt::format("    {}: {}\n", parameter.name, to_yaml(parameter.value));
    }
    for (const auto& [from, to] : node.remaps) {
      text += fmt::format("    {}:={}\n", from, to);
    }
    if (node.autostart) {
      text += "    then configure, activate\n";
    }
  }
  return text;
}

constexpr const char* kLeftToRun = "depends on a function that only a run calls";

std::string left_to_run_as_text(const LeftToRun& left) {
  if (!left.function.empty()) {
    return fmt::format("function {} ({})\n  {}\n", left.function, to_string(left.where), kLeftToRun);
  }
  return fmt::format("action ({})\n  {}: {}\n", to_string(left.where), kLeftToRun, left.error);
}

std::string content_as_text(const LaunchPlan& plan, const Environment& launcher_environment, bool of_handler);

std::string handler_as_text(const EventHandler& handler, const LaunchPlan& reaction,
                            const Environment& launcher_environment) {
  std::string content = content_as_text(reaction, launcher_environment, true);
  while (content.ends_with("\n\n")) {
    content.pop_back();
  }
  return fmt::format("{} ({})\n{}\n", describe(handler), to_string(handler.where), indented(content, 2));
}

// Everything but the last line.
std::string content_as_text(const LaunchPlan& plan, const Environment& launcher_environment, bool of_handler) {
  std::string traces;
  std::vector<std::string> processes;
  std::string to_nodes;
  std::string coroutines;
  std::string handlers;
  std::string effects;  // told of handlers only
  auto reaction = plan.reactions.begin();
  for_each_request(
      plan,
      Overloaded{
          [&](const RunScopePtr& scope) { traces += scope_as_text(*scope) + "\n"; },
          [&](const ProcessCommand& command) { effects += describe(command) + "\n"; },
          [&](const EventHandler& handler) { handlers += handler_as_text(handler, *reaction++, launcher_environment); },
          [&](const LoadRequest& load) { to_nodes += load_request_as_text(load) + "\n"; },
          [&](const TransitionRequest& request) {
            to_nodes += fmt::format("change state of {} ({})\n  {}\n\n", request.node, to_string(request.origin),
                                    fmt::join(request.transitions, ", "));
          },
          [&](const ProcessSpec& spec) { processes.push_back(process_as_text(spec, launcher_environment)); },
          [&](const CoroutineRequest& request) {
            coroutines += fmt::format("coroutine {}\n\n", request.object->describe());
          },
          [&](const Dependency& dependency) {
            processes[dependency.process] += fmt::format("  {}\n", dependency_as_text(dependency));
          },
          PassOver<UnregisterRequest, TestRequest, TimerRequest>(),
          PassOver<ShutdownRequest, NodeDescription>(),  // the last effect, once; the command line names the node
      });
  std::string text = traces;
  for (const std::string& process : processes) {
    text += process + "\n";
  }
  text += to_nodes + coroutines;
  for (const LeftToRun& left : plan.left_to_run) {
    text += left_to_run_as_text(left) + "\n";
  }
  text += handlers;
  if (of_handler) {
    for (const std::string& log : plan.logs) {
      effects += fmt::format("log {}\n", shell_quoted(log));
    }
    text += effects + (plan.shutdowns.empty() ? "" : "shutdown\n");
  }
  return text;
}

}  // namespace

std::string plan_as_text(const LaunchPlan& plan, const Environment& launcher_environment) {
  std::string counts =
      counted(plan.processes.size(), "process", "processes") + ", " + counted(plan.scopes.size(), "trace", "traces");
  if (!plan.handlers.empty()) {
    counts += ", " + counted(plan.handlers.size(), "event handler", "event handlers");
  }
  return fmt::format("{}{}; nothing was started\n", content_as_text(plan, launcher_environment, false), counts);
}

namespace {

Json dependency_as_json(const Dependency& dependency) {
  return {{"until", describe(dependency)},
          {"timeout", dependency.timeout ? Json(std::chrono::duration<double>(*dependency.timeout).count()) : Json()},
          {"on_failure", to_string(dependency.on_failure)},
          {"source", source_as_json(dependency.where)}};
}

void add_content(Json& root, const LaunchPlan& plan, const Environment& launcher_environment);

Json handler_as_json(const EventHandler& handler, const LaunchPlan& reaction, const Environment& launcher_environment) {
  Json json;
  json["event"] = describe(handler);
  json["once"] = handler.once;
  json["source"] = source_as_json(handler.where);
  add_content(json, reaction, launcher_environment);
  return json;
}

Json scope_as_json(const RunScope& scope) {
  Json trace;
  for (const ShownSetting& setting : scope.describe()) {
    std::visit([&](const auto& held) { trace[setting.name] = held; }, setting.value);
  }
  trace["source"] = source_as_json(scope.origin());
  return trace;
}

Json left_to_run_as_json(const LeftToRun& left) {
  Json item;
  item["function"] = left.function.empty() ? Json(nullptr) : Json(left.function);
  item["why"] = kLeftToRun;
  if (!left.error.empty()) {
    item["error"] = left.error;
  }
  item["source"] = left.where ? source_as_json(left.where) : Json(nullptr);
  return item;
}

void add_content(Json& root, const LaunchPlan& plan, const Environment& launcher_environment) {
  Json processes = Json::array();
  Json loads = Json::array();
  Json transitions;
  Json traces = Json::array();
  Json coroutines;
  Json commands;
  Json handlers;
  auto reaction = plan.reactions.begin();
  for_each_request(
      plan, Overloaded{
                [&](const RunScopePtr& scope) { traces.push_back(scope_as_json(*scope)); },
                [&](const ProcessCommand& command) {
                  commands.push_back({{"command", describe(command)}, {"source", source_as_json(command.where)}});
                },
                [&](const EventHandler& handler) {
                  handlers.push_back(handler_as_json(handler, *reaction++, launcher_environment));
                },
                [&](const LoadRequest& load) { loads.push_back(load_request_as_json(load)); },
                [&](const TransitionRequest& request) {
                  transitions.push_back({{"node", request.node}, {"transitions", request.transitions}});
                },
                [&](const ProcessSpec& spec) {
                  const Duration delay = plan.delays[processes.size()];
                  Json& process = processes.emplace_back(process_as_json(spec, launcher_environment));
                  if (delay > Duration(0)) {
                    process["after"] = std::chrono::duration<double>(delay).count();
                  }
                },
                [&](const CoroutineRequest& coroutine) { coroutines.push_back(coroutine.object->describe()); },
                [&](const NodeDescription& node) {
                  processes[node.process]["node"] = {{"package", or_null(node.package)},
                                                     {"executable", node.executable},
                                                     {"name", or_null(node.name)},
                                                     {"namespace", or_null(node.name_space)}};
                },
                [&](const Dependency& dependency) {
                  processes[dependency.process]["depends_on"].push_back(dependency_as_json(dependency));
                },
                PassOver<UnregisterRequest, TestRequest, TimerRequest>(),
                PassOver<ShutdownRequest>(),  // told once
            });
  const auto add_if_any = [&](const char* key, Json& list) {
    if (!list.empty()) {
      root[key] = std::move(list);
    }
  };
  root["processes"] = std::move(processes);
  root["composable"] = std::move(loads);
  add_if_any("transitions", transitions);
  root["traces"] = std::move(traces);
  root["logs"] = plan.logs;
  root["python_includes"] = plan.python_includes;
  root["includes"] = plan.includes;
  root["shutdown"] = !plan.shutdowns.empty();
  add_if_any("coroutines", coroutines);
  add_if_any("commands", commands);
  for (const LeftToRun& left : plan.left_to_run) {
    root["only_in_a_run"].push_back(left_to_run_as_json(left));
  }
  add_if_any("handlers", handlers);
}

}  // namespace

std::string plan_as_json(const LaunchPlan& plan, const Environment& launcher_environment) {
  Json root;
  root["version"] = kDryRunVersion;
  root["outcome"] = "ok";
  add_content(root, plan, launcher_environment);
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace launch
