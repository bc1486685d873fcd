// SPDX-License-Identifier: Apache-2.0
// A launch as other supervisors can run it: what of a plan becomes a service of theirs, and what they can't say.
//
// A service is a process with its command line, environment, order, restarts and limits. Handlers, traces, health and
// the like are the launcher's own. They are listed, never dropped without a word.
#pragma once

#include <cstddef>
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
};

struct Service {
  std::string name;  // of the process; "talker-2" for the second of that name
  const ProcessSpec* spec = nullptr;
  Duration delay{0};  // from the start of all, by a timer of the launch file
  std::vector<ServiceBefore> before;
};

struct LeftOut {
  std::string what;  // "the respawn delay that grows of 'talker'"
  SourceRange where;
};

// `services` refers to the plan.
struct DeploymentPlan {
  std::vector<Service> services;
  std::vector<LeftOut> left_out;
};

DeploymentPlan deployment_of(const LaunchPlan& plan);

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
  std::string name;               // of the target; other names begin with it
  std::string directory;          // where the files will be: an absolute path
  std::string working_directory;  // of processes for which the launch file names none: an absolute path
  std::string image;              // of containers
  bool of_user = false;           // for the service manager of a user
  std::string user;               // whose processes units of the system are; empty: root's
  Environment shell;              // in which the export was made
};

// The first line of each file, by which an export knows its own files again.
std::string export_mark(const DeploymentOptions& options);

Deployment as_systemd_units(const LaunchPlan& plan, const DeploymentOptions& options);
Deployment as_compose_file(const LaunchPlan& plan, const DeploymentOptions& options);
Deployment as_kubernetes_objects(const LaunchPlan& plan, const DeploymentOptions& options);

// The command line of a service, with these paths for its generated files; a shell is part of it where the launch file
// asks for one.
std::vector<std::string> command_line_of(const ProcessSpec& spec, const std::vector<std::string>& paths_of_files);
// The names of the generated files of a service: "talker-params.yaml".
std::vector<std::string> file_names_of(const Service& service);

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
ServiceVariables variables_of(const ProcessSpec& spec, const Environment& shell, ShellVariables of_shell);

}  // namespace launch
