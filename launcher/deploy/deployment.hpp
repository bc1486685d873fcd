// SPDX-License-Identifier: Apache-2.0
// A launch as other supervisors can run it: what of a plan becomes a service of theirs, and what they can't say.
//
// A service is a process with its command line, environment, order, restarts and limits. Handlers, traces, health and
// the like are the launcher's own. They are listed, never dropped without a word.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "base/environment/environment.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

// A service that must have started, or ended, before.
struct ServiceBefore {
  std::size_t service = 0;  // index
  bool ended = false;       // it must have ended; else it must have started
  bool succeeded = false;   // with exit code 0
  bool wanted = false;      // if that can't be, the waiting service starts nevertheless
  bool ends_all = false;    // if that can't be, the whole ends
  bool healthy = false;     // it must have become healthy, beside having started
  std::string waits{};      // "'b' waits until 'a' has started"
  SourceRange where{};
};

struct Service {
  std::string name;  // of the process; "talker-2" for the second of that name
  std::string word;  // the name in names of files and units: letters, digits, ".", "_" and "-"; no other service has it
  const ProcessSpec* spec = nullptr;
  Duration delay{0};               // from the start of all, by a timer of the launch file
  std::vector<std::string> files;  // names of the generated files: "talker.yaml", "talker.2.yaml"
  std::vector<ServiceBefore> before;
};

struct LeftOut {
  std::string what;  // "the respawn delay that grows of 'talker'"
  SourceRange where;
};
// "not exported: the terminal of 'talker' (system.launch.xml:3:2)", in one line.
std::string to_string(const LeftOut& left_out);

// `services` refers to the plan.
struct DeploymentPlan {
  std::vector<Service> services;
  std::vector<LeftOut> left_out;
};

DeploymentPlan deployment_of(const LaunchPlan& plan);

// The services of one machine; the first part has those of this machine, with an empty name. What services of two
// machines have to do with each other is left out. There is at least one part.
struct MachinePart {
  std::string machine;
  std::vector<Service> services;
};
std::vector<MachinePart> parts_of(DeploymentPlan& plan);

// What is written. Paths are relative to the folder of the export.
struct DeployedFile {
  std::string path;
  std::string content;
};
struct Deployment {
  std::vector<DeployedFile> files;
  std::vector<LeftOut> left_out;
};

struct DeploymentOptions {
  std::string kind;       // "--systemd", "--compose", "--kubernetes"
  std::string name;       // of the target; other names begin with it
  std::string machine;    // to which the files of one folder belong; empty: this one
  std::string directory;  // where the files are written: an absolute path
  std::string
      install_directory;  // where they will be, on each machine: an absolute path; empty: where they are written
  std::string working_directory;  // of processes for which the launch file names none: an absolute path
  std::string image;              // of containers
  bool of_user = false;           // for the service manager of a user
  std::string user;               // whose processes units of the system are; empty: root's
  Environment shell;              // in which the export was made
  std::map<std::string, Environment> shells_elsewhere;  // of other machines, before a launch file has changed them
};

const Environment& shell_of(const ProcessSpec& spec, const DeploymentOptions& options);

// The first line of each file, by which an export knows its own files again.
std::string export_mark(const DeploymentOptions& options);

// Writes the services of each machine, those of another machine into a folder of its name.
using WritePart = std::function<Deployment(const std::vector<Service>&, const DeploymentOptions&)>;
Deployment deploy_parts(const LaunchPlan& plan, const DeploymentOptions& options, const WritePart& write);
// Puts what is left out into the head of the first file.
void add_head(Deployment& deployment);

Deployment as_systemd_units(const LaunchPlan& plan, const DeploymentOptions& options);
Deployment as_compose_file(const LaunchPlan& plan, const DeploymentOptions& options);
Deployment as_kubernetes_objects(const LaunchPlan& plan, const DeploymentOptions& options);

// The command line of a service, with these paths for its generated files; a shell is part of it where the launch file
// asks for one.
std::vector<std::string> command_line_of(const ProcessSpec& spec, const std::vector<std::string>& paths_of_files);

// What a service needs of the environment of its shell, with what the launch file sets. `of_shell`: which variables of
// the shell are taken along. Variables that the launch file removes are in `removed`.
struct ServiceVariables {
  std::vector<std::pair<std::string, std::string>> set;
  std::vector<std::string> removed;
};
enum class ShellVariables {
  kAll,       // of ROS 2, its middlewares and LTTng, and paths of programs and libraries
  kSettings,  // of ROS 2 and its middlewares alone: a container has paths of its own
};
// "7.5", as systemd and Compose read it.
std::string seconds_text(Duration time);
// From the first signal to SIGKILL; never 0, which systemd takes for no limit.
Duration stop_timeout_of(const ProcessSpec& spec);

ServiceVariables variables_of(const ProcessSpec& spec, const Environment& shell, ShellVariables of_shell);

}  // namespace launch
