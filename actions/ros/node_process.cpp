// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/node_process.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>

#include "actions/process/process_findings.hpp"
#include "actions/ros/parameter_file.hpp"
#include "actions/ros/parameter_file_findings.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

// Appends the arguments for what the scope sets for every node.
void append_global_parameters(ProcessSpec& spec, LaunchContext& context) {
  const Scope& scope = context.scope();
  for (const GlobalParameter& parameter : scope.global_parameters) {
    if (const auto* const named = std::get_if<NamedParameter>(&parameter)) {
      spec.argv.insert(spec.argv.end(), {"-p", named->name + ":=" + to_argument(named->value)});
      continue;
    }
    const auto& file = std::get<ParameterFilePath>(parameter);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file.path, ignored)) {
      throw LaunchError(fmt::format("parameter file path is not a file: {}", file.path), file.where,
                        help_for_missing_file(file.path), Finding::kMissingParameterFile);
    }
    spec.argv.insert(spec.argv.end(), {"--params-file", file.path});
    find_faults_of_parameter_file(file.path, file.where, context);
  }
}

}  // namespace

std::vector<AttributeSpec> NodeProcess::attributes(bool named) {
  std::vector<AttributeSpec> attributes = {
      {"exec", AttributeType::kText, true, "", "the program, looked up in the package"},
      {"pkg", AttributeType::kText, false, "", "the package; none: exec is a path or found on PATH"},
      {"name", AttributeType::kText, named, named ? "" : "the program decides", "name of the node"},
      {"exec_name", AttributeType::kText, false, "base name of the program", "label of the process"},
      {"namespace", AttributeType::kText, named, "", "namespace of the node, below that of the scope"},
      {"args", AttributeType::kCommandLine, false, "", "more arguments, before --ros-args"},
      {"ros_args", AttributeType::kCommandLine, false, "", "more ROS arguments, after --ros-args"}};
  const std::vector<AttributeSpec> common = ProcessFields::attributes();
  attributes.insert(attributes.end(), common.begin(), common.end());
  return attributes;
}

std::vector<ItemSpec> NodeProcess::items() {
  std::vector<ItemSpec> items = ProcessFields::items();
  items.push_back(Parameters::item());
  items.push_back(remap_item());
  return items;
}

NodeProcess::NodeProcess(const Fields& fields)
    : where_(fields.where()),
      package_(fields.optional_text("pkg")),
      executable_(fields.text("exec")),
      name_(fields.optional_text("name")),
      exec_name_(fields.optional_text("exec_name")),
      namespace_(fields.optional_text("namespace")),
      arguments_(fields.words("args")),
      ros_arguments_(fields.optional_words("ros_args")),
      remaps_(remaps_of(fields)),
      process_(fields) {
  const std::vector<const Fields*> parameters = fields.items("param");
  parameters_.reserve(parameters.size());
  for (const Fields* parameter : parameters) {
    parameters_.emplace_back(*parameter);
  }
}

std::string NodeProcess::request(LaunchContext& context) const {
  Scope& scope = context.scope();
  ProcessSpec spec;
  spec.argv.reserve(arguments_.size() + 2 * (parameters_.size() + remaps_.size()) + 8);
  spec.files.reserve(parameters_.size());
  spec.argv.push_back(program(scope));
  for (const Template& word : arguments_) {
    spec.argv.push_back(word.perform(scope));
  }
  if (ros_arguments_) {
    spec.argv.push_back("--ros-args");
    for (const Template& word : *ros_arguments_) {
      spec.argv.push_back(word.perform(scope));
    }
  }
  spec.argv.push_back("--ros-args");

  NodeDescription node;
  node.process = context.requests().processes.size();
  node.package = package_ ? std::optional(package_->perform(scope)) : std::nullopt;
  node.executable = executable_.perform(scope);
  node.name = node_name(scope);
  node.name_space = resolve_namespace(namespace_, scope, where_);
  const auto remap = [&](std::string rule) {
    spec.argv.emplace_back("-r");
    spec.argv.push_back(std::move(rule));
  };
  if (node.name) {
    remap("__node:=" + *node.name);
  }
  if (node.name_space) {
    remap("__ns:=" + *node.name_space);
  }
  const std::string full_name = node.name && node.name_space ? qualified_name(*node.name_space, *node.name) : "";
  if (node.name) {
    spec.other_names = {*node.name, qualified_name(node.name_space.value_or("/"), *node.name)};
  }
  if (!full_name.empty()) {
    context.note_node(full_name);
  }
  append_global_parameters(spec, context);
  for (const Parameters& parameters : parameters_) {
    parameters.append_to(spec, context, full_name);
  }
  for (const auto& [from, to] : scope.global_remaps) {
    remap(from + ":=" + to);
  }
  for (const auto& [from, to] : remaps_) {
    const std::string before = from.perform(scope);
    const std::string after = to.perform(scope);
    find_invalid_remap(before, from.where(), after, to.where(), context);
    remap(before + ":=" + after);
  }

  for (const LaunchContext::NodeLogLevel& wish : context.log_levels()) {
    const auto is_meant = [&](const std::string& name) { return ::fnmatch(wish.node.c_str(), name.c_str(), 0) == 0; };
    if (wish.node.empty() || is_meant(node.executable) ||
        std::any_of(spec.other_names.begin(), spec.other_names.end(), is_meant)) {
      spec.argv.insert(spec.argv.end(), {"--log-level", wish.level});
    }
  }

  if (exec_name_) {
    spec.name = exec_name_->perform(scope);
  }
  process_.request(context, std::move(spec));
  context.requests().nodes.push_back(std::move(node));
  return full_name;
}

std::string NodeProcess::program(Scope& scope) const {
  const std::string executable = executable_.perform(scope);
  if (!package_) {
    return executable;
  }
  const std::string package = package_->perform(scope);
  try {
    return scope.packages->executable(executable, package, scope.environment);
  } catch (const std::runtime_error& error) {
    // If the package itself can't be found, the error is at the package.
    try {
      scope.packages->prefix(package, scope.environment);
    } catch (const std::runtime_error&) {
      throw LaunchError(error.what(), package_->where(), scope.packages->help_for_missing(package, scope.environment),
                        Finding::kMissingPackage);
    }
    throw LaunchError(error.what(), executable_.where(),
                      did_you_mean(executable, scope.packages->executables(package, scope.environment)),
                      Finding::kMissingProgram);
  }
}

std::optional<std::string> NodeProcess::node_name(Scope& scope) const {
  if (!name_) {
    return std::nullopt;
  }
  std::string name = name_->perform(scope);
  if (!is_valid_node_name(name)) {
    throw LaunchError(fmt::format("invalid node name '{}'", name), name_->where(),
                      "use letters, digits and underscores, not starting with a digit", Finding::kInvalidName);
  }
  return name;
}

ItemSpec remap_item() {
  return {"remap",
          "renames a topic, a service or an action",
          {{"from", AttributeType::kText, true, "", "the name in the program"},
           {"to", AttributeType::kText, true, "", "the name to use"}}};
}

std::vector<std::pair<Template, Template>> remaps_of(const Fields& fields) {
  std::vector<std::pair<Template, Template>> remaps;
  const std::vector<const Fields*> items = fields.items("remap");
  remaps.reserve(items.size());
  for (const Fields* remap : items) {
    remaps.emplace_back(remap->text("from"), remap->text("to"));
  }
  return remaps;
}

}  // namespace launch
