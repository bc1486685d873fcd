#include "launcher/cli/dry_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <optional>

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

std::map<std::string, std::optional<std::string>> difference(const Environment& of, const Environment& to) {
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

// The argv of a process with "@params:N" for generated files, whose contents go to `contents`.
std::vector<std::string> plain_argv(const ProcessSpec& spec, std::vector<std::string>& contents) {
  std::vector<std::string> argv = spec.argv;
  for (const GeneratedFile& file : spec.files) {
    argv[file.argument] = fmt::format("@params:{}", contents.size());
    contents.push_back(file.content);
  }
  return argv;
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=@%+,-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  std::string quoted = "'";
  for (const char character : word) {
    quoted += character == '\'' ? std::string("'\\''") : std::string(1, character);
  }
  return quoted + "'";
}

std::string indented(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    result += "      " + text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return result;
}

}  // namespace

std::string plan_as_text(const LaunchPlan& plan, const Environment& launcher_environment) {
  std::string text;
  for (const auto& scope : plan.scopes) {
    text += fmt::format("{} ({})\n", scope->kind(), to_string(scope->origin()));
    for (const ScopeSetting& setting : scope->describe()) {
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
    text += '\n';
  }
  std::vector<std::string> contents;
  for (const ProcessSpec& spec : plan.processes) {
    const std::size_t first_content = contents.size();
    std::string command;
    for (const std::string& word : plain_argv(spec, contents)) {
      command += (command.empty() ? "" : " ") + (spec.shell ? word : shell_quoted(word));
    }
    text += fmt::format("{} ({})\n  {}\n", spec.name, to_string(spec.origin), command);
    if (!spec.working_directory.empty()) {
      text += fmt::format("  cwd: {}\n", spec.working_directory);
    }
    for (const auto& [name, value] : difference(spec.environment, launcher_environment)) {
      text +=
          value ? fmt::format("  env: {}={}\n", name, shell_quoted(*value)) : fmt::format("  env: {} removed\n", name);
    }
    for (std::size_t i = first_content; i < contents.size(); ++i) {
      text += fmt::format("  @params:{}:\n{}", i, indented(contents[i]));
    }
    text += '\n';
  }
  text += fmt::format("{} processes, {} traces; nothing was started\n", plan.processes.size(), plan.scopes.size());
  return text;
}

std::string plan_as_json(const LaunchPlan& plan, const Environment& launcher_environment) {
  Json processes = Json::array();
  std::vector<std::string> contents;
  for (const ProcessSpec& spec : plan.processes) {
    Json process;
    process["name"] = spec.name;
    process["argv"] = plain_argv(spec, contents);
    process["cwd"] = spec.working_directory.empty() ? Json(nullptr) : Json(spec.working_directory);
    Json environment = Json::object();
    for (const auto& [name, value] : difference(spec.environment, launcher_environment)) {
      environment[name] = value ? Json(*value) : Json(nullptr);
    }
    process["env"] = std::move(environment);
    process["shell"] = spec.shell;
    if (spec.origin) {
      process["source"] = {{"file", spec.origin.file->path()},
                           {"line", spec.origin.file->position(spec.origin.begin).line}};
    }
    processes.push_back(std::move(process));
  }
  Json traces = Json::array();
  for (const auto& scope : plan.scopes) {
    Json trace;
    for (const ScopeSetting& setting : scope->describe()) {
      std::visit([&](const auto& held) { trace[setting.name] = held; }, setting.value);
    }
    trace["source"] = {{"file", scope->origin().file->path()},
                       {"line", scope->origin().file->position(scope->origin().begin).line}};
    traces.push_back(std::move(trace));
  }
  Json root;
  root["processes"] = std::move(processes);
  root["params"] = contents;
  root["traces"] = std::move(traces);
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace launch
