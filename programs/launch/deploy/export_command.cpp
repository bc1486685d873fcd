// SPDX-License-Identifier: Apache-2.0
// `launch export`: makes of a launch file what systemd, Compose or Kubernetes runs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/systemd_text.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/machines/machine_connections.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/deploy/exported_files.hpp"
#include "programs/launch/unit/unit_file.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kComposeFile = "compose.yaml";  // as_compose_file()

struct ExportWords {
  LaunchTarget target;
  std::string systemd;
  std::string compose;
  std::string kubernetes;
  std::string name;
  std::string image;
  std::string user;
  std::string install_directory;
  std::vector<std::string> machines;  // NAME=COMMAND
  std::vector<std::string> machine_files;
  bool of_user = false;
  bool strict = false;
  bool offline = false;
  PythonLimits python;

  // What is wrong with them; empty: nothing.
  std::string mistake() const {
    const int targets = !systemd.empty() + !compose.empty() + !kubernetes.empty();
    if (targets != 1) {
      return "one of --systemd DIR, --compose FILE and --kubernetes DIR is needed";
    }
    if (systemd.empty() && image.empty()) {
      return "containers need --image IMAGE, which has the programs of the launch file at their places";
    }
    if (!systemd.empty() && !image.empty()) {
      return "--image is for --compose and --kubernetes";
    }
    if (systemd.empty() && (of_user || !user.empty())) {
      return "--user and --as are for --systemd";
    }
    if (systemd.empty() && !install_directory.empty()) {
      return "--install-dir is for --systemd";
    }
    if (!install_directory.empty() && !install_directory.starts_with('/')) {
      return fmt::format("--install-dir {} is no absolute path", install_directory);
    }
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
      return "--name has a character that no name can have";
    }
    for (const std::string& machine : machines) {
      if (const std::size_t equals = machine.find('=');
          equals == std::string::npos || equals == 0 ||
          machine.find_first_not_of(" \t", equals + 1) == std::string::npos) {
        return fmt::format("--machine {} is no machine, expected NAME=COMMAND, such as 'arm=ssh robot2'", machine);
      }
    }
    return of_user && !user.empty() ? "--as needs units of the system, which --user excludes" : "";
  }
};

// What follows for the units of one folder: those of a machine.
std::string units_step(const ExportWords& words, const Deployment& deployment, const DeploymentOptions& options,
                       const std::string& folder) {
  const char* const user = words.of_user ? "--user " : "";
  const fs::path written = folder.empty() ? fs::path(options.directory) : fs::path(options.directory) / folder;
  const fs::path there = options.install_directory.empty() ? written : fs::path(options.install_directory);
  std::set<std::string> kinds;  // of units: "/etc/robot/*.service"
  for (const DeployedFile& file : deployment.files) {
    if (fs::path(file.path).parent_path() == folder) {
      kinds.insert(fmt::format(" {}/*{}", there.string(), fs::path(file.path).extension().string()));
    }
  }
  const std::string copy =
      there == written ? "" : fmt::format("copy {}/ to {}/, then ", written.string(), there.string());
  return fmt::format("next{}: {}systemctl {}link{}, then systemctl {}enable --now {}.target\n",
                     folder.empty() ? "" : " on machine '" + folder + "'", copy, user, fmt::join(kinds, ""), user,
                     unit_name(options.name));
}

std::string next_step(const ExportWords& words, const LaunchPlan& plan, const Deployment& deployment,
                      const DeploymentOptions& options) {
  std::set<std::string> machines;
  for (const ProcessSpec& process : plan.processes) {
    machines.insert(process.machine);
  }
  if (!words.kubernetes.empty()) {
    machines.erase("");
    std::string labels;
    for (const std::string& machine : machines) {
      labels +=
          fmt::format("kubectl label node NODE launch.machine={}, with the node that is '{}', then ", machine, machine);
    }
    return fmt::format("next: {}kubectl apply -f {}\n", labels, options.directory);
  }
  if (machines.empty()) {
    machines.insert("");
  }
  std::string steps;
  for (const std::string& machine : machines) {
    if (!words.systemd.empty()) {
      steps += units_step(words, deployment, options, machine);
    } else if (machine.empty()) {
      steps += fmt::format("next: docker compose -f {} up\n", words.compose);
    } else {
      steps += fmt::format("next on machine '{}', with the files of {}/{}: docker compose -f {} up\n", machine,
                           options.directory, machine, fs::path(words.compose).filename().string());
    }
  }
  return steps;
}

// The user of the units, "" for root. Throws std::runtime_error.
std::string user_of(const std::string& given) {
  std::string name = given;
  if (name.empty()) {
    const Environment environment = own_environment();
    const auto caller = environment.find("SUDO_USER");
    const passwd* const own = ::getpwuid(::geteuid());
    name = ::geteuid() == 0 && caller != environment.end() ? caller->second : own == nullptr ? "" : own->pw_name;
  }
  if (!name.empty() && ::getpwnam(name.c_str()) == nullptr) {
    throw std::runtime_error(fmt::format("there is no user '{}'", name));
  }
  return name == "root" ? "" : name;
}

// Without a slash at its end. Empty if it is.
std::string absolute_folder(const fs::path& path) {
  std::string folder = path.empty() ? "" : fs::absolute(path).lexically_normal().string();
  while (folder.size() > 1 && folder.ends_with('/')) {
    folder.pop_back();
  }
  return folder;
}

DeploymentOptions options_of(const ExportWords& words, const std::vector<std::string>& files) {
  const std::string beginning = "launch-";
  DeploymentOptions options{.kind = !words.systemd.empty()   ? "--systemd"
                                    : !words.compose.empty() ? "--compose"
                                                             : "--kubernetes",
                            .name = words.name,
                            .machine = "",
                            .directory = "",
                            .install_directory = absolute_folder(words.install_directory),
                            .working_directory = fs::current_path().string(),
                            .image = words.image,
                            .of_user = words.of_user,
                            .user = words.of_user || words.systemd.empty() ? "" : user_of(words.user),
                            .shell = own_environment(),
                            .shells_elsewhere = {}};
  if (options.name.empty()) {
    options.name = files.front() == "-" ? "launch" : unit_name_of(files.front()).substr(beginning.size());
  }
  const fs::path place = !words.systemd.empty()   ? fs::path(words.systemd)
                         : !words.compose.empty() ? fs::absolute(words.compose).parent_path()
                                                  : fs::path(words.kubernetes);
  options.directory = absolute_folder(place);
  return options;
}

std::map<std::string, std::string> commands_of(const std::vector<std::string>& machines) {
  std::map<std::string, std::string> commands;
  for (const std::string& machine : machines) {
    const std::size_t equals = machine.find('=');
    commands.insert_or_assign(machine.substr(0, equals), machine.substr(equals + 1));
  }
  return commands;
}

// A connection that a machine has closed is an error that is told, not the end of this process.
class NoBrokenPipe {
 public:
  NoBrokenPipe() : before_(::signal(SIGPIPE, SIG_IGN)) {}
  ~NoBrokenPipe() { ::signal(SIGPIPE, before_); }
  NoBrokenPipe(const NoBrokenPipe&) = delete;
  NoBrokenPipe& operator=(const NoBrokenPipe&) = delete;

 private:
  sighandler_t before_;
};

// Asks the machines of the launch file, unless it is done `offline`. `shells` get the environment that each has before
// the file changes it.
LaunchPlan plan_with_machines(LaunchContext& context, const LaunchDescription& description, bool offline,
                              std::map<std::string, Environment>& shells) {
  const NoBrokenPipe no_broken_pipe;
  const std::unique_ptr<EventLoop> loop = make_sd_event_loop();
  MachineConnections machines(*loop, LAUNCH_VERSION, [](LogLevel level, const std::string& text) {
    if (level >= LogLevel::kWarning) {
      fmt::print(stderr, "launch export: {}\n", text);
    }
  });
  if (!offline) {
    context.machines().use_connector(machines);
  }
  LaunchPlan plan = plan_launch(context, description, PlannedScopes::kLeftOut);
  context.machines().check_files();
  for (const ProcessSpec& process : plan.processes) {
    if (!process.machine.empty() && !shells.contains(process.machine)) {
      shells[process.machine] = context.machines().find(process.machine, process.origin)->environment();
    }
  }
  return plan;
}

Deployment deployment_for(const ExportWords& words, const LaunchPlan& plan, const DeploymentOptions& options) {
  if (!words.systemd.empty()) {
    return as_systemd_units(plan, options);
  }
  if (!words.kubernetes.empty()) {
    return as_kubernetes_objects(plan, options);
  }
  Deployment deployment = as_compose_file(plan, options);
  for (DeployedFile& file : deployment.files) {
    if (fs::path path = file.path; path.filename() == kComposeFile) {
      file.path = path.replace_filename(fs::path(words.compose).filename()).string();
    }
  }
  return deployment;
}

}  // namespace

int export_command(const Words& given) {
  ExportWords words;
  Subcommand command(
      "launch export",
      "Makes of a launch file what systemd, Compose or Kubernetes runs, without the launcher: a service for "
      "each process. What can't be said there is listed.");
  command.take_target(words.target);
  command.take_text("--systemd", words.systemd, "write units of systemd and their target into this folder");
  command.take_text("--compose", words.compose, "write this file for docker compose or podman compose");
  command.take_text("--kubernetes", words.kubernetes, "write objects of Kubernetes into this folder");
  command.take_text("--name", words.name, "name of the target, project or objects (default: that of the file)");
  command.take_text("--image", words.image, "image of the containers, with the programs of the file at their places");
  command.take_flag("--user", words.of_user, "units for the service manager of a user");
  command.take_text("--as", words.user,
                    "the user whose processes they are (default: who exports; of root, who has called sudo)");
  command.take_text("--install-dir", words.install_directory,
                    "where the files of the units will be, on each machine (default: where they are written)");
  command.take_texts("--machine", words.machines,
                     "NAME=COMMAND: what leads to a machine, in place of its `connect` in the launch file; "
                     "NAME=local: this machine");
  command.take_texts("--machines", words.machine_files,
                     "a launch file with `machine` and `assign_machine`, which is visited before the others");
  command.take_flag("--offline", words.offline,
                    "ask no other machine; what only a machine knows is listed, and written in angle brackets");
  command.take_flag("--strict", words.strict, "write nothing, and exit with 1, if something can't be said there");
  command.take_python_limits(words.python);
  if (const auto exit_code = command.parse(given)) {
    return *exit_code;
  }
  if (const std::string mistake = words.mistake(); !mistake.empty()) {
    fmt::print(stderr, "{}", usage_error("launch export", mistake));
    return kWrongCommandLine;
  }
  run_python_in_a_guest({std::chrono::seconds(words.python.seconds), words.python.memory});
  ResultOutput result("launch export");
  const Registry registry = builtin_actions();
  LaunchContext context(registry, own_environment(), own_prefix(), [](auto, auto, auto) {});
  context.scope().log_directory = LogDirectory::choose(own_environment());
  for (const auto& [name, value] : words.target.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  std::vector<std::string> files = find_launch_files(words.target.words, context.scope(), listed_command_names());
  DeploymentOptions options = options_of(words, files);
  files.insert(files.begin(), words.machine_files.begin(), words.machine_files.end());
  const auto description = load_launch_files(files, registry, context.scope());
  context.machines().set_commands(commands_of(words.machines));
  const LaunchPlan plan = plan_with_machines(context, *description, words.offline, options.shells_elsewhere);
  const Deployment deployment = deployment_for(words, plan, options);
  const bool writes = !words.strict || deployment.left_out.empty();
  if (writes) {
    write_exported_files(deployment, options);
    for (const DeployedFile& file : deployment.files) {
      result.print(fmt::format("{}/{}\n", options.directory, file.path));
    }
  }
  for (const LeftOut& left : deployment.left_out) {
    result.print(to_string(left) + "\n");
  }
  result.print(writes ? next_step(words, plan, deployment, options) : "nothing is written, because of --strict\n");
  return result.finish() && writes ? 0 : 1;
}

}  // namespace launch
