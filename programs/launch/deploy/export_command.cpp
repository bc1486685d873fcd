// SPDX-License-Identifier: Apache-2.0
// `launch export`: makes of a launch file what systemd, Compose or Kubernetes runs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pwd.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/deploy/deployment.hpp"
#include "launcher/deploy/systemd_text.hpp"
#include "launcher/invocation/find_launch_file.hpp"
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

struct ExportWords {
  LaunchTarget target;
  std::string systemd;
  std::string compose;
  std::string kubernetes;
  std::string name;
  std::string image;
  std::string user;
  bool of_user = false;
  bool strict = false;
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
    return of_user && !user.empty() ? "--as needs units of the system, which --user excludes" : "";
  }
};

std::string next_step(const ExportWords& words, const Deployment& deployment, const DeploymentOptions& options) {
  if (!words.systemd.empty()) {
    const char* const user = words.of_user ? "--user " : "";
    std::set<std::string> kinds;  // of units: "/etc/robot/*.service"
    for (const DeployedFile& file : deployment.files) {
      if (file.path.find('/') == std::string::npos) {
        kinds.insert(fmt::format(" {}/*{}", options.directory, fs::path(file.path).extension().string()));
      }
    }
    return fmt::format("next: systemctl {}link{}, then systemctl {}enable --now {}.target\n", user,
                       fmt::join(kinds, ""), user, unit_name(options.name));
  }
  return words.compose.empty() ? fmt::format("next: kubectl apply -f {}\n", options.directory)
                               : fmt::format("next: docker compose -f {} up\n", words.compose);
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

DeploymentOptions options_of(const ExportWords& words, const std::vector<std::string>& files) {
  const std::string beginning = "launch-";
  DeploymentOptions options{.name = words.name,
                            .directory = "",
                            .working_directory = fs::current_path().string(),
                            .image = words.image,
                            .of_user = words.of_user,
                            .user = words.of_user || words.systemd.empty() ? "" : user_of(words.user),
                            .shell = own_environment()};
  if (options.name.empty()) {
    options.name = files.front() == "-" ? "launch" : unit_name_of(files.front()).substr(beginning.size());
  }
  const fs::path place = !words.systemd.empty()   ? fs::path(words.systemd)
                         : !words.compose.empty() ? fs::absolute(words.compose).parent_path()
                                                  : fs::path(words.kubernetes);
  options.directory = fs::absolute(place).lexically_normal().string();
  while (options.directory.size() > 1 && options.directory.ends_with('/')) {
    options.directory.pop_back();
  }
  return options;
}

Deployment deployment_for(const ExportWords& words, const LaunchPlan& plan, const DeploymentOptions& options) {
  if (!words.systemd.empty()) {
    return as_systemd_units(plan, options);
  }
  if (!words.kubernetes.empty()) {
    return as_kubernetes_objects(plan, options);
  }
  Deployment deployment = as_compose_file(plan, options);
  deployment.files.front().path = fs::path(words.compose).filename().string();
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
  const std::vector<std::string> files = find_launch_files(words.target.words, context.scope(), listed_command_names());
  const auto description = load_launch_files(files, registry, context.scope());
  const LaunchPlan plan = plan_launch(context, *description);
  const DeploymentOptions options = options_of(words, files);
  const Deployment deployment = deployment_for(words, plan, options);
  const bool writes = !words.strict || deployment.left_out.empty();
  if (writes) {
    write_exported_files(deployment, options);
    for (const DeployedFile& file : deployment.files) {
      result.print(fmt::format("{}/{}\n", options.directory, file.path));
    }
  }
  for (const LeftOut& left : deployment.left_out) {
    result.print(fmt::format("not exported: {} ({})\n", left.what, to_string(left.where)));
  }
  result.print(writes ? next_step(words, deployment, options) : "nothing is written, because of --strict\n");
  return result.finish() && writes ? 0 : 1;
}

}  // namespace launch
