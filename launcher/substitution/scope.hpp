// SPDX-License-Identifier: Apache-2.0
// The state of a launch at one moment, as substitutions see it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "base/environment/environment.hpp"
#include "launcher/substitution/parameter.hpp"

namespace launch {

class MachineView;
class PackageIndex;
struct HomeMachine;
struct ControlGroup;
struct UnrunCommands;

// The names that $(anon) has made, in their order. Another reading of the launch file gets the same ones.
struct AnonymousNames {
  std::map<std::string, std::vector<std::string>> made;
  std::map<std::string, std::size_t> used;  // of them, in this reading
};

// Copied when a scoped group begins and put back when it ends (launcher/visit/launch_context.hpp).
struct Scope {
  // Launch configurations: what $(var x) reads.
  std::map<std::string, std::string> configurations;
  // The launch environment: what $(env X) reads and what children inherit.
  Environment environment;
  // The settings that every later node gets before its own parameters and remaps, in the order in which they were set.
  std::vector<GlobalParameter> global_parameters;
  std::vector<std::pair<std::string, std::string>> global_remaps;  // from, to
  // Variables of the enclosing `for` and `for_each`: what $(index i) and $(for-var x) read.
  std::map<std::string, std::string> loop_variables;
  // The names of the groups around the action that is visited, the outermost first.
  std::vector<std::string> groups;
  // The limits of the enclosing groups, the outermost first (launcher/process/control_groups/control_group.hpp).
  std::vector<std::shared_ptr<const ControlGroup>> control_groups;
  // The launch file being visited: what $(dirname) and $(filename) give. Null outside any file.
  std::shared_ptr<const SourceFile> current_file;
  // This run's log directory.
  std::string log_directory;
  // Finds packages by AMENT_PREFIX_PATH of `environment`, never null while visiting.
  std::shared_ptr<PackageIndex> packages;
  // Where processes run, and `environment` and `packages` are (machine_view.hpp). Null: here, and then there is no
  // home.
  std::shared_ptr<MachineView> machine;
  std::shared_ptr<const HomeMachine> home;
  // May be null.
  std::shared_ptr<AnonymousNames> anonymous_names;
  // Tells the user what is suspicious but no error, with its place. May be empty.
  std::function<void(const SourceRange& where, const std::string& text)> warn;
  // Learns which files besides launch files had their substitutions performed. May be empty.
  std::function<void(const std::shared_ptr<const SourceFile>&)> note_performed_file;
  // A plan is looking at what waits for an event or a timer: functions of launch files must not be called.
  bool only_planned = false;
  // What is planned is certain to happen: a timer fires. A file that is included then makes its description as always.
  bool planned_by_timer = false;
  // Keeps commands from being run (unrun_commands.hpp). Null: they are run.
  std::shared_ptr<UnrunCommands> unrun_commands;
  // A function that might have changed this scope has not been called, so what follows may fail for that reason.
  bool incomplete = false;

  // Forgets the configurations, parameters and remaps: for `reset`, and for `forwarding="false"` of a group.
  void clear_configurations() {
    configurations.clear();
    global_parameters.clear();
    global_remaps.clear();
  }

  // Whether a command was left out since the last call of forget_left_out_command().
  bool command_was_left_out() const;
  void forget_left_out_command();
};

}  // namespace launch
