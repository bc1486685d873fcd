// SPDX-License-Identifier: Apache-2.0
// The machine on which the processes of a scope run, if it is another one: what substitutions and parameters look up is
// looked up there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/environment/environment.hpp"
#include "launcher/substitution/command_output.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

class PackageIndex;

// Functions that ask the machine throw std::runtime_error, in one line, to which the caller adds the place.
class MachineView {
 public:
  virtual ~MachineView() = default;

  virtual const std::string& name() const = 0;
  // False in a plan, which asks no machine: then there is a text in angle brackets for what is not known.
  virtual bool is_connected() const = 0;
  // That of a process there, before a launch file changes it.
  virtual const Environment& environment() const = 0;
  virtual std::shared_ptr<PackageIndex> packages() = 0;

  virtual std::vector<bool> are_files(const std::vector<std::string>& paths) = 0;
  virtual std::string read_file(const std::string& path) = 0;
  virtual CommandOutput run(const std::string& program, const std::vector<std::string>& words,
                            const Environment& environment, bool merge_error) = 0;
};

// This machine, for what is read here whatever the scope: launch files.
struct HomeMachine {
  Environment environment;  // before a launch file changes it
  std::shared_ptr<PackageIndex> packages;
};

// The environment `now`, which has come from `before`, as if it had come from `onto`: the variables that a launch file
// has set, appended to and removed. What it has decided (environment.hpp) counts even if it has changed nothing.
Environment carry_changes(const Environment& before, const Environment& now, const Environment& onto);

// The environment and packages of this machine, with what the launch file has changed.
Environment home_environment(const Scope& scope);
std::shared_ptr<PackageIndex> home_packages(const Scope& scope);

// "<HOME on arm>": in a plan, for what only the machine knows.
std::string unknown_there(const std::string& what, const MachineView& machine);

}  // namespace launch
