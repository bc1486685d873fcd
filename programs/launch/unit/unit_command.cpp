// SPDX-License-Identifier: Apache-2.0
// `launch unit install`, `remove` and `status`: a launch that systemd starts with the machine.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/command_error.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/run/command_line.hpp"
#include "programs/launch/unit/service_manager.hpp"
#include "programs/launch/unit/unit_file.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// For what a launch does beside waiting for its processes: it ends its traces.
constexpr std::chrono::seconds kForTraces{30};
constexpr int kNotActive = 3;  // as systemctl(1)
constexpr int kNoSuchUnit = 4;

// Loads the file as a launch does, and looks how long its processes may take to end. Throws LaunchError.
std::chrono::seconds stop_timeout_of(const LaunchTarget& target, std::vector<std::string>& files) {
  const Registry registry = builtin_actions();
  LaunchContext context(registry, own_environment(), own_prefix(), [](auto, auto, auto) {});
  for (const auto& [name, value] : target.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  files = find_launch_files(target.words, context.scope(), listed_command_names());
  const LaunchPlan plan = plan_launch(context, *load_launch_files(files, registry, context.scope()));
  Duration longest{0};
  const std::function<void(const LaunchPlan&)> look = [&](const LaunchPlan& part) {
    for (const ProcessSpec& process : part.processes) {
      longest = std::max(longest, process.sigterm_timeout + process.sigkill_timeout);
    }
    std::for_each(part.reactions.begin(), part.reactions.end(), look);
  };
  look(plan);
  return std::chrono::ceil<std::chrono::seconds>(longest) + kForTraces;
}

void check_name(const std::string& name) {
  const bool good = !name.empty() && name.size() <= 200 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == ':' || c == '@';
  });
  if (!good) {
    throw std::runtime_error(fmt::format("'{}' can't be the name of a unit", name));
  }
}

// The options and the name of `launch unit remove` and `status`. Returns the exit code when there is nothing more to
// do.
struct NamedUnit {
  std::optional<int> parse(const std::string& command_name, const std::string& description, const Words& words) {
    Subcommand command(command_name, description);
    command.take_text("NAME", name, "name of the unit");
    command.take_flag("--user", user, "a unit of this user's service manager");
    if (const auto exit_code = command.parse(words)) {
      return exit_code;
    }
    if (name.empty()) {
      fmt::print(stderr, "{}", usage_error(command_name, "the name of a unit is missing"));
      return kWrongCommandLine;
    }
    check_name(name);
    return std::nullopt;
  }

  std::string name;
  bool user = false;
};

bool is_ours(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) && line == kUnitMark;
}

// systemd sets HOME for a user that the unit names, and nodes need it, so a unit of the system names one always.
void choose_user(UnitFile& unit, const Environment& environment) {
  if (unit.of_user) {
    if (!unit.user.empty()) {
      throw std::runtime_error("--as needs a unit of the system, which root installs");
    }
    return;
  }
  if (unit.user.empty()) {
    const auto caller = environment.find("SUDO_USER");
    unit.user = caller == environment.end() ? "root" : caller->second;
  }
  if (::getpwnam(unit.user.c_str()) == nullptr) {
    throw std::runtime_error(fmt::format("there is no user '{}'", unit.user));
  }
}

int install(const Words& words) {
  LaunchTarget target;
  std::string name;
  UnitFile unit;
  bool user = false;
  bool print = false;
  bool no_start = false;
  std::vector<std::string> also;
  std::vector<std::string> options;
  Subcommand command("launch unit install",
                     "Makes a unit of systemd that runs a launch file, and starts it now and with the machine.");
  command.take_target(target);
  command.take_text("--name", name, "name of the unit (default: launch- and the name of the file)");
  command.take_flag("--user", user, "for the service manager of this user; so it is without root's rights");
  command.take_text("--as", unit.user, "the user whose processes they are (default: who has called sudo)");
  command.take_texts("--env", also, "take this variable of the environment along, too");
  command.take_texts("--option", options, "an option for the launch, such as --option=--trace");
  command.take_flag("--realtime", unit.realtime, "allow real-time priorities and locked memory");
  command.take_flag("--hardened", unit.hardened, "take rights away that few nodes need, among them sudo");
  command.take_flag("--no-start", no_start, "start it with the machine only, not now");
  command.take_flag("--print", print, "print the unit, install nothing");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  const SystemdManager manager(user);
  std::vector<std::string> files;
  unit.stop_timeout = stop_timeout_of(target, files);
  if (files.empty() || files.front() == "-") {
    throw std::runtime_error(
        "a unit needs a launch file that is still there when the machine starts, not standard input");
  }
  unit.of_user = manager.is_of_user();
  unit.description = fmt::format("launch {}", fs::path(files.front()).filename().string());
  Words launch_words = options;
  for (const std::string& file : files) {
    launch_words.push_back(fs::absolute(file).lexically_normal().string());
  }
  for (const auto& [argument, value] : target.arguments) {
    launch_words.push_back(argument + ":=" + value);
  }
  if (std::holds_alternative<ExitNow>(parse_command_line(launch_words))) {
    return kWrongCommandLine;  // an --option that a launch does not have, or does not run with
  }
  unit.command = launch_words;
  unit.command.insert(unit.command.begin(), own_prefix() + "/bin/launch");
  unit.directory = fs::current_path().string();
  const Environment environment = own_environment();
  for (const std::string& variable : also) {
    if (!environment.contains(variable)) {
      throw std::runtime_error(fmt::format("there is no variable '{}' to take along", variable));
    }
  }
  unit.variables = variables_for_unit(environment, also);
  choose_user(unit, environment);
  name = name.empty() ? unit_name_of(files.front()) : name;
  check_name(name);
  const std::string text = unit_text(unit);
  if (print) {
    ResultOutput result("launch unit install");
    result.print(text);
    return result.finish() ? 0 : 1;
  }
  const fs::path path = manager.path_of(name);
  if (fs::exists(path) && !is_ours(path)) {
    throw std::runtime_error(fmt::format("'{}' was not made by launch; choose another --name", path.string()));
  }
  fs::create_directories(path.parent_path());
  if (std::ofstream file(path); !(file << text).flush()) {
    throw std::runtime_error(fmt::format("'{}' can't be written", path.string()));
  }
  fmt::print("{} is written\n", path.string());
  std::fflush(stdout);
  if (manager.is_of_user() && !manager.lingers()) {
    fmt::print("it starts when this user logs in; 'loginctl enable-linger' makes it start with the machine\n");
    std::fflush(stdout);
  }
  if (!manager.runs()) {
    manager.enable_later(name);
    fmt::print("{}\n", manager.is_of_user() ? "the service manager of this user does not run, so nothing starts now"
                                            : "systemd does not run here; it starts the launch with the machine");
    return 0;
  }
  manager.tell({"daemon-reload"});
  manager.tell({"enable", name + ".service"});
  if (!no_start) {
    manager.tell({"restart", "--no-block", name + ".service"});
    fmt::print("{} starts; see 'launch unit status {}' and 'journalctl {}-u {}'\n", name, name,
               manager.is_of_user() ? "--user " : "", name);
  }
  return 0;
}

int remove(const Words& words) {
  NamedUnit unit;
  if (const auto exit_code =
          unit.parse("launch unit remove", "Ends a launch that systemd runs, and takes its unit away.", words)) {
    return *exit_code;
  }
  const SystemdManager manager(unit.user);
  const std::string service = unit.name + ".service";
  const fs::path path = manager.path_of(unit.name);
  if (!fs::exists(path)) {
    throw std::runtime_error(fmt::format("there is no '{}'", path.string()));
  }
  if (!is_ours(path)) {
    throw std::runtime_error(fmt::format("'{}' was not made by launch", path.string()));
  }
  if (manager.runs()) {
    manager.tell({"disable", "--now", service});
  }
  fs::remove(manager.link_of(unit.name));
  fs::remove(path);
  if (manager.runs()) {
    manager.tell({"daemon-reload"});
  }
  fmt::print("{} is removed\n", path.string());
  return 0;
}

int status(const Words& words) {
  NamedUnit unit;
  if (const auto exit_code = unit.parse("launch unit status", "Says what a launch does that systemd runs.", words)) {
    return *exit_code;
  }
  const std::string& name = unit.name;
  std::map<std::string, std::string> properties = SystemdManager(unit.user).properties_of(name);
  if (properties["LoadState"] != "loaded") {
    fmt::print(stderr, "{}", command_error("launch unit status", fmt::format("there is no unit '{}'", name)));
    return kNoSuchUnit;
  }
  const bool active = properties["ActiveState"] == "active" || properties["ActiveState"] == "activating" ||
                      properties["ActiveState"] == "reloading";
  std::string text = fmt::format("{}: {} ({})", name, properties["ActiveState"], properties["SubState"]);
  if (active && !properties["StatusText"].empty()) {
    text += ", " + properties["StatusText"];
  }
  if (active && properties["MainPID"] != "0") {
    text += fmt::format(", launch {}", properties["MainPID"]);
  }
  if (!active && properties["Result"] != "success") {
    text += fmt::format(", {}, exit code {}", properties["Result"], properties["ExecMainStatus"]);
  }
  if (properties["NRestarts"] != "0") {
    text += fmt::format(", restarts: {}", properties["NRestarts"]);
  }
  fmt::print("{}\n", text);
  return active ? 0 : kNotActive;
}

}  // namespace

// The words begin with "unit".
Words unit_words(const Words& words) {
  if (words.size() <= 2) {
    return {"install", "remove", "status"};
  }
  if (words[1] == "install") {
    return launch_file_words({words.begin() + 2, words.end()});
  }
  Words names;
  for (const bool user : {false, true}) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(SystemdManager(user).directory(), unreadable)) {
      if (entry.path().extension() == ".service" && is_ours(entry.path())) {
        names.push_back(entry.path().stem().string());
      }
    }
  }
  return names;
}

int unit_command(const Words& words) {
  const std::string verb = words.empty() ? "" : words.front();
  const Words rest(words.empty() ? words.begin() : words.begin() + 1, words.end());
  if (verb == "install") {
    return install(rest);
  }
  if (verb == "remove") {
    return remove(rest);
  }
  if (verb == "status") {
    return status(rest);
  }
  if (!verb.empty() && verb[0] != '-') {
    fmt::print(stderr, "{}",
               unexpected_word_error("launch unit", {verb}, {{}, {"install", "remove", "status"}},
                                     fmt::format("unknown verb '{}'", verb)));
    return kWrongCommandLine;
  }
  std::string wanted;
  Subcommand command(
      "launch unit",
      "Makes systemd start a launch with the machine. install FILE makes a unit, remove NAME takes it away, "
      "status NAME says what it does. Each has a --help of its own.");
  command.take_choice("VERB", wanted, {"install", "remove", "status"}, "what to do");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  fmt::print(stderr, "{}", usage_error("launch unit", "a verb is missing: install, remove or status"));
  return kWrongCommandLine;
}

}  // namespace launch
