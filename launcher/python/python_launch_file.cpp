// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/python_launch_file.hpp"

#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/python/python_file.hpp"
#include "launcher/substitution/machine_view.hpp"

namespace launch {

namespace {

// An include: the path, and the place that asks for it.
using Key = std::tuple<std::string, const SourceFile*, std::uint32_t>;

struct Loaded {
  Environment environment;  // in which the file was run
  std::shared_ptr<const LaunchDescription> description;
};

// Never freed: it holds objects of an interpreter that isn't ended either.
std::map<Key, Loaded>& loaded_files() {
  static auto* const files = new std::map<Key, Loaded>;
  return *files;
}

std::shared_ptr<const LaunchDescription> run(std::shared_ptr<const SourceFile> file, const Registry& registry,
                                             const Scope& outer) {
  Scope scope;
  // Launch files are read here, also those whose processes run on another machine.
  const Environment before_file = home_environment(outer);
  scope.environment = before_file;
  scope.packages = home_packages(outer);
  scope.log_directory = outer.log_directory;
  scope.warn = outer.warn;
  scope.unrun_commands = outer.unrun_commands;
  scope.current_file = file;

  const auto python_file = std::make_shared<PythonFile>(file, registry);
  auto description = std::make_shared<LaunchDescription>();
  python::Runtime* runtime = nullptr;
  try {
    runtime = &python_runtime();
  } catch (const std::runtime_error& error) {
    throw LaunchError(error.what(), {file, 0, 0}, {}, Finding::kPython);
  }
  try {
    PythonHost host(*python_file, scope);
    description->actions = python_file->make_actions(runtime->load(file->path(), file->text(), host));
  } catch (const python::Error& error) {
    python_file->places().fail(error);
  }
  for (const auto& [name, value] : scope.environment) {
    const auto before = before_file.find(name);
    if (before == before_file.end() || before->second != value) {
      description->environment_changes.emplace(name, value);
    }
  }
  for (const auto& [name, value] : before_file) {
    if (!scope.environment.contains(name)) {
      description->environment_changes.emplace(name, std::nullopt);
    }
  }
  description->file = std::move(file);
  return description;
}

}  // namespace

std::shared_ptr<const LaunchDescription> load_python_launch_file(std::shared_ptr<const SourceFile> file,
                                                                 const Registry& registry, const Scope& scope) {
  const SourceRange& included_from = file->included_from();
  if (!included_from) {
    return run(std::move(file), registry, scope);
  }
  const Key key(file->path(), included_from.file.get(), included_from.begin);
  const auto known = loaded_files().find(key);
  if (known != loaded_files().end() && known->second.description->file->text() == file->text() &&
      known->second.environment == scope.environment) {
    return known->second.description;
  }
  auto description = run(std::move(file), registry, scope);
  loaded_files().insert_or_assign(key, Loaded{scope.environment, description});
  return description;
}

}  // namespace launch
