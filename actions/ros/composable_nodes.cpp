// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/composable_nodes.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "actions/parameters/parameter_file.hpp"
#include "actions/ros/node_process.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

constexpr const char* kTags[] = {"composable_node", "composable_lifecycle_node"};

namespace fs = std::filesystem;

// The text of a file of parameters for all nodes, if it is on another machine.
std::string text_of_scope_file(const std::string& path, const SourceRange& where, LaunchContext& context) {
  MachineView* const machine = context.scope().machine.get();
  if (machine == nullptr) {
    return {};
  }
  try {
    return machine->read_file(path) + "\n";
  } catch (const std::runtime_error& error) {
    throw LaunchError(error.what(), where, {}, Finding::kMissingParameterFile);
  }
}

// The resource of the ament index that a container reads: a line PLUGIN;LIBRARY for each plugin.
fs::path registrations_of(const std::string& prefix, const std::string& package) {
  return fs::path(prefix) / "share/ament_index/resource_index/rclcpp_components" / package;
}

// The package must exist, and one of its libraries must register the plugin.
void find_missing_plugin(const ComposableNode& node, const Environment& environment, const SourceRange& package_where,
                         const SourceRange& plugin_where, LaunchContext& context) {
  if (!context.exploration().is_on() || context.scope().machine != nullptr) {
    return;
  }
  PackageIndex& packages = *context.scope().packages;
  std::string prefix;
  try {
    prefix = packages.prefix(node.package, environment);
  } catch (const std::runtime_error& error) {
    context.exploration().remark({Severity::kError, error.what(), package_where,
                                  packages.help_for_missing(node.package, environment), Finding::kMissingPackage});
    return;
  }
  std::ifstream file(registrations_of(prefix, node.package));
  if (!file) {
    context.exploration().remark(
        {Severity::kError, fmt::format("no component of package '{}' is installed", node.package), package_where,
         fmt::format("'{}' does not exist; the build of the package writes it (rclcpp_components_register_nodes)",
                     registrations_of(prefix, node.package).string()),
         Finding::kMissingPlugin});
    return;
  }
  std::vector<std::string> plugins;
  for (std::string line; std::getline(file, line);) {
    const std::size_t end = line.find(';');
    plugins.push_back(line.substr(0, end));
    if (plugins.back() != node.plugin) {
      continue;
    }
    const fs::path library = end == std::string::npos ? fs::path() : fs::path(prefix) / line.substr(end + 1);
    std::error_code ignored;
    if (!library.empty() && !fs::exists(library, ignored)) {
      context.exploration().remark(
          {Severity::kError, fmt::format("the library of plugin '{}' does not exist", node.plugin), plugin_where,
           fmt::format("package '{}' names '{}'", node.package, library.string()), Finding::kMissingPlugin});
    }
    return;
  }
  std::string help = did_you_mean(node.plugin, plugins);
  if (help.empty() && !plugins.empty()) {
    help = fmt::format("it has {}{}", plugins.front(), plugins.size() > 1 ? " and others" : "");
  }
  context.exploration().remark(
      {Severity::kError, fmt::format("no library of package '{}' registers the plugin '{}'", node.package, node.plugin),
       plugin_where, std::move(help), Finding::kMissingPlugin});
}

}  // namespace

std::vector<ItemSpec> ComposableNodes::items() {
  ItemSpec node;
  node.tag = kTags[0];
  node.help = "a node that the container loads from a library";
  node.attributes = {{"pkg", AttributeType::kText, true, "", "the package that registers the plugin"},
                     {"plugin", AttributeType::kText, true, "", "its class, such as demo::Talker"},
                     {"name", AttributeType::kText, true, "", "name of the node"},
                     {"namespace", AttributeType::kText, false, "", "namespace of the node, below that of the scope"}};
  node.items = {Parameters::item(),
                remap_item(),
                {"extra_arg",
                 "an option for the container, such as use_intra_process_comms",
                 {{"name", AttributeType::kText, true, "", "name of the option"},
                  {"value", AttributeType::kText, true, "", "its value, typed by YAML 1.1 rules"}}}};
  node.has_condition = true;

  ItemSpec lifecycle = node;
  lifecycle.tag = kTags[1];
  lifecycle.help = "a composable node with a managed life cycle";
  lifecycle.attributes.push_back(
      {"autostart", AttributeType::kBoolean, false, "false", "configure and activate the node"});
  return {std::move(node), std::move(lifecycle)};
}

ComposableNodes::ComposableNodes(const Fields& fields) {
  for (const char* const tag : kTags) {
    for (const Fields* item : fields.items(tag)) {
      Description node{*item, {}};
      for (const Fields* parameter : item->items("param")) {
        node.parameters.emplace_back(*parameter);
      }
      nodes_.push_back(std::move(node));
    }
  }
}

void ComposableNodes::request(LaunchContext& context, const std::string& target, const Environment& environment,
                              const SourceRange& where) const {
  LoadRequest request;
  request.target = target;
  request.environment = environment;
  request.origin = where;
  for (const Description& node : nodes_) {
    if (node.fields.condition().holds(context.scope())) {
      request.nodes.push_back(evaluate(node, environment, context));
    }
  }
  if (!request.nodes.empty()) {
    context.requests().loads.push_back(std::move(request));
  }
}

ComposableNode ComposableNodes::evaluate(const Description& node, const Environment& environment,
                                         LaunchContext& context) {
  Scope& scope = context.scope();
  const Fields& fields = node.fields;
  ComposableNode result;
  result.origin = fields.where();
  result.package = fields.text("pkg").perform(scope);
  result.plugin = fields.text("plugin").perform(scope);
  result.name = fields.text("name").perform(scope);
  result.name_space = resolve_namespace(fields.optional_text("namespace"), scope, fields.where()).value_or("");
  result.autostart = fields.boolean("autostart", false).perform(scope);
  find_missing_plugin(result, environment, fields.where("pkg"), fields.where("plugin"), context);
  const std::string full_name = qualified_name(result.name_space, result.name);
  if (!result.name_space.empty() && !result.name.empty()) {
    context.note_node(full_name);
  }
  const KnownNodeName known{
      result.name.empty() ? std::nullopt : std::optional(result.name),
      result.name_space.empty() ? std::nullopt : std::optional(result.name_space),
  };
  for (const GlobalParameter& parameter : scope.global_parameters) {
    if (const auto* const named = std::get_if<NamedParameter>(&parameter)) {
      result.parameters.push_back(*named);
    } else if (scope.machine == nullptr || scope.machine->is_connected()) {
      const auto& file = std::get<ParameterFilePath>(parameter);
      append_parameter_file({file.path, file.where, known, true, text_of_scope_file(file.path, file.where, context)},
                            context, result.parameters);
    }
  }
  for (const Parameters& parameters : node.parameters) {
    parameters.append_to(result.parameters, context, known);
  }
  result.remaps = scope.global_remaps;
  for (const Fields* each : fields.items("remap")) {
    result.remaps.push_back(perform_remap(*each, context));
  }
  for (const Fields* argument : fields.items("extra_arg")) {
    const Template& value = argument->text("value");
    result.extra_arguments.push_back(
        {argument->text("name").perform(scope), typed_parameter(value.perform(scope), value.where())});
  }
  return result;
}

}  // namespace launch
