// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/machines.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {
namespace {

// For a plan: packages of a machine that nobody asks.
class PlannedPackages : public PackageIndex {
 public:
  explicit PlannedPackages(std::string machine) : machine_(std::move(machine)) {}

  std::string prefix(const std::string& package, const Environment& /*environment*/) override {
    return fmt::format("<prefix of {} on {}>", package, machine_);
  }
  std::string executable(const std::string& executable, const std::string& package,
                         const Environment& environment) override {
    return executable.find('/') != std::string::npos
               ? executable
               : fmt::format("{}/lib/{}/{}", prefix(package, environment), package, executable);
  }
  std::vector<std::string> packages(const Environment& /*environment*/) const override { return {}; }
  std::string help_for_missing(const std::string& /*package*/, const Environment& /*environment*/) const override {
    return {};
  }
  std::vector<std::string> executables(const std::string& /*package*/, const Environment& /*environment*/) override {
    return {};
  }
  std::string find_program(const std::string& name, const Environment& /*environment*/) override {
    return name.find('/') != std::string::npos ? name : fmt::format("<{} on {}>", name, machine_);
  }

 private:
  std::string machine_;
};

class PlannedMachine : public MachineView {
 public:
  explicit PlannedMachine(std::string name)
      : name_(std::move(name)), packages_(std::make_shared<PlannedPackages>(name_)) {}

  const std::string& name() const override { return name_; }
  bool is_connected() const override { return false; }
  const Environment& environment() const override { return environment_; }
  std::shared_ptr<PackageIndex> packages() override { return packages_; }
  std::vector<bool> are_files(const std::vector<std::string>& paths) override {
    return std::vector<bool>(paths.size(), true);
  }
  std::string read_file(const std::string& path) override { return unknown_there("text of " + path, *this); }
  CommandOutput run(const std::string& /*program*/, const std::vector<std::string>& words,
                    const Environment& /*environment*/, bool /*merge_error*/) override {
    return {.text = unknown_there("output of " + words.front(), *this), .error = {}, .status = 0};
  }

 private:
  std::string name_;
  Environment environment_;
  std::shared_ptr<PackageIndex> packages_;
};

bool is_machine_name(const std::string& name) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && is_word(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_word(c) || c == '_' || c == '-' || c == '.'; });
}

}  // namespace

bool MachineDeclaration::same_as(const MachineDeclaration& other) const {
  return name == other.name && connect == other.connect && launch == other.launch && setup == other.setup &&
         keepalive == other.keepalive && connect_timeout == other.connect_timeout && keep == other.keep &&
         grace == other.grace && keep_for == other.keep_for;
}

void Machines::set_commands(std::map<std::string, std::string> commands) {
  commands_ = std::move(commands);
  for (const auto& [name, command] : commands_) {
    if (split_shell_words(command, {}).empty()) {
      throw LaunchError(fmt::format("--machine {} has no command", name), {},
                        "it is a command that leads there, such as 'ssh robot', or local");
    }
    declare({.name = name, .connect = command, .where = {}, .connect_where = {}});
    unused_commands_.insert(name);
  }
}

void Machines::declare(MachineDeclaration machine) {
  if (!is_machine_name(machine.name)) {
    throw LaunchError(fmt::format("'{}' is no name for a machine", machine.name), machine.where,
                      "use letters, digits, '_', '-' and '.', beginning with a letter or a digit",
                      Finding::kInvalidName);
  }
  if (machine.name == kLocalMachine) {
    throw LaunchError("'local' is the name of this machine, and needs no declaration", machine.where,
                      "give the other machine another name", Finding::kInvalidName);
  }
  if (const auto command = commands_.find(machine.name); command != commands_.end()) {
    machine.connect = command->second;
    unused_commands_.erase(machine.name);
  }
  const auto known = declared_.find(machine.name);
  if (known != declared_.end() && known->second.where && !known->second.same_as(machine)) {
    throw LaunchError(
        fmt::format("machine '{}' is declared differently in {}", machine.name, to_string(known->second.where)),
        machine.where, "one launch has one machine of a name", Finding::kExclusive);
  }
  const MachineDeclaration& declared = declared_.insert_or_assign(machine.name, std::move(machine)).first->second;
  if (!declared.is_local() && connector_ != nullptr && refusal_.empty()) {
    connector_->connect(declared);
  }
}

void Machines::require_declared(const std::string& name, const SourceRange& where) {
  if (declared_.contains(name)) {
    unused_commands_.erase(name);
    return;
  }
  std::vector<std::string> names = {kLocalMachine};
  for (const auto& [known, declaration] : declared_) {
    names.push_back(known);
  }
  const std::string help = did_you_mean(name, names);
  throw LaunchError(
      fmt::format("there is no machine '{}'", name), where,
      help.empty() ? fmt::format("declare it before: <machine name=\"{}\" connect=\"ssh …\"/>", name) : help,
      Finding::kUndefined);
}

std::shared_ptr<MachineView> Machines::find(const std::string& name, const SourceRange& where) {
  if (name == kLocalMachine) {
    return nullptr;
  }
  require_declared(name, where);
  const MachineDeclaration& machine = declared_.at(name);
  if (machine.is_local()) {
    return nullptr;
  }
  if (trace_of_all_) {
    throw LaunchError(fmt::format("a setting of the <trace> of this launch ({}) works on this machine only",
                                  to_string(trace_of_all_)),
                      where, "write machine=\"local\" in the <trace> to record this machine only", Finding::kExclusive);
  }
  if (plan_only_ && connector_ == nullptr) {
    std::shared_ptr<MachineView>& view = views_[name];
    if (view == nullptr) {
      view = std::make_shared<PlannedMachine>(name);
    }
    return view;
  }
  if (!refusal_.empty() || connector_ == nullptr) {
    throw LaunchError(refusal_.empty() ? "other machines can't be reached here" : refusal_, where, {},
                      Finding::kExclusive);
  }
  return views_[name] = connector_->await(machine);
}

const MachineAssignment* Machines::assigned(const AssignableProcess& process) {
  const auto fits = [](const std::string& pattern, const std::string& text) {
    return pattern.empty() || ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
  };
  const auto fits_namespace = [&](const std::string& pattern) {
    return fits(pattern, process.name_space) || fits(pattern + "/*", process.name_space);
  };
  const auto found = std::find_if(assignments_.begin(), assignments_.end(), [&](const MachineAssignment& each) {
    return fits(each.package, process.package) && fits_namespace(each.name_space) &&
           (each.process.empty() || std::any_of(process.names.begin(), process.names.end(),
                                                [&](const std::string& name) { return fits(each.process, name); }));
  });
  if (found == assignments_.end()) {
    return nullptr;
  }
  found->used = true;
  return &*found;
}

std::vector<std::string> Machines::unused_commands() const {
  std::vector<std::string> known;
  for (const auto& [name, declaration] : declared_) {
    if (!unused_commands_.contains(name)) {
      known.push_back(name);
    }
  }
  std::vector<std::string> sentences;
  for (const std::string& name : unused_commands_) {
    const std::string help = did_you_mean(name, known);
    sentences.push_back(
        fmt::format("--machine {0}: so far the launch has no machine '{0}'{1}", name, help.empty() ? "" : "; " + help));
  }
  return sentences;
}

std::vector<const MachineAssignment*> Machines::unused_assignments() const {
  std::vector<const MachineAssignment*> unused;
  for (const MachineAssignment& assignment : assignments_) {
    if (!assignment.used) {
      unused.push_back(&assignment);
    }
  }
  return unused;
}

void Machines::expect_file(const std::shared_ptr<MachineView>& machine, std::string path, const SourceRange& where,
                           std::function<void()> warn) {
  if (machine->is_connected()) {
    files_[machine].push_back({std::move(path), where, std::move(warn)});
  }
}

void Machines::check_files() {
  const auto all = std::exchange(files_, {});
  for (const auto& [machine, files] : all) {
    std::vector<std::string> paths;
    for (const ExpectedFile& file : files) {
      paths.push_back(file.path);
    }
    std::vector<bool> there;
    try {
      there = machine->are_files(paths);
    } catch (const std::runtime_error& error) {
      throw LaunchError(error.what(), files.front().where);
    }
    for (std::size_t i = 0; i < files.size() && i < there.size(); ++i) {
      if (there[i]) {
        continue;
      }
      if (files[i].warn) {
        files[i].warn();
        continue;
      }
      throw LaunchError(fmt::format("parameter file path is not a file on machine '{}': {}", machine->name(), paths[i]),
                        files[i].where, "$(find-pkg-share PACKAGE)/… leads to the file of the package there",
                        Finding::kMissingParameterFile);
    }
  }
}

void Machines::require_only_this_machine(const SourceRange& where) {
  if (!views_.empty()) {
    throw LaunchError(
        fmt::format("this setting of <trace> works on this machine only, and processes run on machine '{}'",
                    views_.begin()->first),
        where, "write machine=\"local\" to record this machine only", Finding::kExclusive);
  }
  trace_of_all_ = where;
}

std::vector<const MachineDeclaration*> Machines::elsewhere() const {
  std::vector<const MachineDeclaration*> all;
  for (const auto& [name, machine] : declared_) {
    if (!machine.is_local()) {
      all.push_back(&machine);
    }
  }
  return all;
}

void move_to_machine(Scope& scope, const std::shared_ptr<MachineView>& machine, const Environment& initial) {
  if (scope.machine == machine) {
    return;
  }
  auto home =
      scope.machine != nullptr ? scope.home : std::make_shared<const HomeMachine>(HomeMachine{initial, scope.packages});
  const Environment& before = scope.machine != nullptr ? scope.machine->environment() : home->environment;
  const Environment& onto = machine != nullptr ? machine->environment() : home->environment;
  scope.environment = carry_changes(before, scope.environment, onto);
  scope.packages = machine != nullptr ? machine->packages() : home->packages;
  scope.home = machine != nullptr ? home : nullptr;
  scope.machine = machine;
}

Environment graph_environment(const Scope& scope, const Environment& of_process) {
  if (scope.machine == nullptr) {
    return of_process;
  }
  constexpr const char* kDomain = "ROS_DOMAIN_ID";
  Environment environment = home_environment(scope);
  if (const auto domain = of_process.find(kDomain); domain != of_process.end()) {
    environment.insert_or_assign(kDomain, domain->second);
  } else if (scope.machine->is_connected()) {
    environment.erase(kDomain);
  }
  return environment;
}

}  // namespace launch
