// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/node_process.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "actions/parameters/parameter_file.hpp"
#include "actions/process/machine_settings.hpp"
#include "actions/values/quirks.hpp"
#include "actions/values/ros_names.hpp"
#include "base/text/names.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

// Appends the arguments for what the scope sets for every node.
void append_global_parameters(ProcessSpec& spec, LaunchContext& context) {
  const KnownNodeName node = known_node_name(spec.argv);
  const Scope& scope = context.scope();
  for (const GlobalParameter& parameter : scope.global_parameters) {
    if (const auto* const named = std::get_if<NamedParameter>(&parameter)) {
      spec.argv.insert(spec.argv.end(), {"-p", named->name + ":=" + to_argument(named->value)});
      continue;
    }
    const auto& file = std::get<ParameterFilePath>(parameter);
    if (scope.machine != nullptr) {
      context.machines().expect_file(scope.machine, file.path, file.where);
      spec.argv.insert(spec.argv.end(), {"--params-file", file.path});
      continue;
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file.path, ignored)) {
      throw LaunchError(fmt::format("parameter file path is not a file: {}", file.path), file.where,
                        help_for_missing_file(file.path), Finding::kMissingParameterFile);
    }
    spec.argv.insert(spec.argv.end(), {"--params-file", file.path});
    find_faults_of_parameter_file({file.path, file.where, node, true}, context);
  }
}

// Tokens with single slashes between them, behind "/" or "~/" or nothing. Wildcards, references and substitutions are
// not judged, because not every release of ROS 2 reads them.
bool is_remappable(std::string_view name) {
  if (name.find_first_of("*\\{}") != std::string_view::npos || name == "~") {
    return true;
  }
  name.remove_prefix(name.starts_with("~/") ? 2 : name.starts_with('/') ? 1 : 0);
  while (true) {
    const std::size_t slash = name.find('/');
    if (!is_valid_node_name(name.substr(0, slash))) {
      return false;
    }
    if (slash == std::string_view::npos) {
      return true;
    }
    name.remove_prefix(slash + 1);
  }
}

void remark_remap(const std::string& name, const SourceRange& where, LaunchContext& context) {
  context.exploration().remark(
      {Severity::kError,
       name.empty() ? "a name of the remap is empty" : fmt::format("'{}' is no name for a remap", name), where,
       "parts of letters, digits and underscores, not starting with a digit, with single slashes between",
       Finding::kInvalidRemap});
}

// A node ends when it can't read one of its remaps.
void find_invalid_remap(const std::string& from, const SourceRange& from_where, const std::string& to,
                        const SourceRange& to_where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  std::string_view before = without_scheme(from);
  const std::string_view after = without_scheme(to);
  if (const std::size_t colon = before.find(':'); colon != std::string_view::npos) {
    before = without_scheme(before.substr(colon + 1));
  }
  if (before.starts_with("__")) {
    return;  // the name of the node or its namespace
  }
  if (!is_remappable(before)) {
    remark_remap(from, from_where, context);
  }
  if (!is_remappable(after)) {
    remark_remap(to, to_where, context);
  }
}

}  // namespace

std::vector<AttributeSpec> NodeProcess::attributes(bool named) {
  return with_process_attributes(
      {{"exec", AttributeType::kText, true, "", "the program, looked up in the package"},
       {"pkg", AttributeType::kText, false, "", "the package; none: exec is a path or found on PATH"},
       {"name", AttributeType::kText, named, named ? "" : "the program decides", "name of the node"},
       {"exec_name", AttributeType::kText, false, "base name of the program", "label of the process"},
       {"namespace", AttributeType::kText, named, "", "namespace of the node, below that of the scope"},
       {"args", AttributeType::kCommandLine, false, "", "more arguments, before --ros-args"},
       {"ros_args", AttributeType::kCommandLine, false, "", "more ROS arguments, after --ros-args"},
       machine_attribute("the machine on which the process runs; local: this one")});
}

std::vector<ItemSpec> NodeProcess::items() {
  std::vector<ItemSpec> items = process_items();
  items.push_back(Parameters::item());
  items.push_back(remap_item());
  return items;
}

NodeProcess::NodeProcess(const Fields& fields) : fields_(fields) {
  const std::vector<const Fields*> parameters = fields_.items("param");
  parameters_.reserve(parameters.size());
  for (const Fields* parameter : parameters) {
    parameters_.emplace_back(*parameter);
  }
  check_process(fields_);
}

std::string NodeProcess::request(LaunchContext& context) const {
  Scope& scope = context.scope();
  ProcessSpec spec;
  const std::vector<Template> arguments = fields_.words("args");
  const std::vector<const Fields*> remaps = fields_.items("remap");
  spec.argv.reserve(arguments.size() + 2 * (parameters_.size() + remaps.size()) + 8);
  spec.files.reserve(parameters_.size());
  spec.argv.push_back(program(scope));
  find_variables_with_blanks(arguments, context);
  for (const Template& word : arguments) {
    spec.argv.push_back(word.perform(scope));
  }
  const std::size_t arguments_end = spec.argv.size();
  if (fields_.has("ros_args")) {
    find_variables_with_blanks(fields_.words("ros_args"), context);
    spec.argv.push_back("--ros-args");
    for (const Template& word : fields_.words("ros_args")) {
      spec.argv.push_back(word.perform(scope));
    }
  }
  const std::size_t ros_arguments_end = spec.argv.size();
  spec.argv.push_back("--ros-args");

  NodeDescription node;
  node.process = context.requests().processes.size();
  node.package = fields_.has("pkg") ? std::optional(fields_.text("pkg").perform(scope)) : std::nullopt;
  node.executable = fields_.text("exec").perform(scope);
  node.name = node_name(scope);
  node.name_space = resolve_namespace(fields_.optional_text("namespace"), scope, fields_.where());
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
  find_faults_of_named_files(spec.argv, 1, arguments_end, fields_.where("args"), context);
  find_faults_of_named_files(spec.argv, arguments_end, ros_arguments_end, fields_.where("ros_args"), context);
  append_global_parameters(spec, context);
  for (const GlobalParameter& parameter : scope.global_parameters) {
    if (const auto* const named = std::get_if<NamedParameter>(&parameter)) {
      node.parameters.push_back(*named);
    }
  }
  for (const Parameters& parameters : parameters_) {
    parameters.append_to(spec, context, full_name, node);
  }
  for (const auto& [from, to] : scope.global_remaps) {
    remap(from + ":=" + to);
  }
  for (const Fields* each : remaps) {
    const auto [from, to] = perform_remap(*each, context);
    remap(from + ":=" + to);
  }

  for (const LaunchContext::NodeLogLevel& wish : context.log_levels()) {
    const auto is_meant = [&](const std::string& name) { return ::fnmatch(wish.node.c_str(), name.c_str(), 0) == 0; };
    if (wish.node.empty() || is_meant(node.executable) ||
        std::any_of(spec.other_names.begin(), spec.other_names.end(), is_meant)) {
      spec.argv.insert(spec.argv.end(), {"--log-level", wish.level});
    }
  }

  if (fields_.has("exec_name")) {
    spec.name = fields_.text("exec_name").perform(scope);
  }
  request_process(fields_, context, std::move(spec));
  context.requests().nodes.push_back(std::move(node));
  return full_name;
}

AssignableProcess NodeProcess::assignable(Scope& scope) const {
  const auto text = [&](const char* name) {
    return fields_.has(name) ? fields_.text(name).perform(scope) : std::string();
  };
  AssignableProcess process{text("pkg"), "", {}};
  process.name_space = resolve_namespace(fields_.optional_text("namespace"), scope, fields_.where()).value_or("/");
  const std::string label =
      fields_.has("exec_name") ? text("exec_name") : std::filesystem::path(text("exec")).filename().string();
  for (const std::string& name : {label, text("name")}) {
    if (!name.empty()) {
      process.names.push_back(name);
    }
  }
  return process;
}

std::string NodeProcess::program(Scope& scope) const {
  const std::string executable = fields_.text("exec").perform(scope);
  if (!fields_.has("pkg")) {
    return executable;
  }
  const std::string package = fields_.text("pkg").perform(scope);
  try {
    return scope.packages->executable(executable, package, scope.environment);
  } catch (const std::runtime_error& error) {
    // If the package itself can't be found, the error is at the package.
    try {
      scope.packages->prefix(package, scope.environment);
    } catch (const std::runtime_error&) {
      throw LaunchError(error.what(), fields_.where("pkg"),
                        scope.packages->help_for_missing(package, scope.environment), Finding::kMissingPackage);
    }
    throw LaunchError(error.what(), fields_.where("exec"),
                      did_you_mean(executable, scope.packages->executables(package, scope.environment)),
                      Finding::kMissingProgram);
  }
}

std::optional<std::string> NodeProcess::node_name(Scope& scope) const {
  if (!fields_.has("name")) {
    return std::nullopt;
  }
  std::string name = fields_.text("name").perform(scope);
  if (!is_valid_node_name(name)) {
    throw LaunchError(fmt::format("invalid node name '{}'", name), fields_.where("name"),
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

std::pair<std::string, std::string> perform_remap(const Fields& remap, LaunchContext& context) {
  std::string from = remap.text("from").perform(context.scope());
  std::string to = remap.text("to").perform(context.scope());
  find_invalid_remap(from, remap.text("from").where(), to, remap.text("to").where(), context);
  return {std::move(from), std::move(to)};
}

}  // namespace launch
