// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "actions/values/quirks.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "launcher/frontend/yaml_document.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

constexpr std::size_t kUsualContent = 120;  // bytes of a generated file

}  // namespace

ItemSpec Parameters::item() {
  return {"param",
          "a parameter, or a file of parameters",
          {{"name", AttributeType::kText, false, "", "name of the parameter"},
           {"value", AttributeType::kParameter, false, "", "its value, typed by YAML 1.1 rules"},
           {"value-sep", AttributeType::kLiteral, false, "", "splits the value into a list (XML)"},
           {"type", AttributeType::kLiteral, false, "by YAML rules",
            "str, bool, int, float, list_of_str, list_of_bool, list_of_int, list_of_float or yaml"},
           {"from", AttributeType::kText, false, "", "path of a parameter file, instead of name and value"},
           {"allow_substs", AttributeType::kBoolean, false, "false", "perform substitutions in the file's text"}},
          true};
}

Parameters::Parameters(const Fields& fields) : where_(fields.where()) {
  if (fields.has("name") && fields.has("from")) {
    throw LaunchError("name and from attributes are mutually exclusive", fields.where("from"),
                      "a file names its parameters itself", Finding::kExclusive);
  }
  if (fields.has("from")) {
    if (fields.has("value") || !fields.items("param").empty()) {
      throw LaunchError("a parameter file can't have a value or nested parameters", fields.where("from"),
                        "write another param for these", Finding::kExclusive);
    }
    file_ = fields.text("from");
    Scope nothing;
    allow_substitutions_ = fields.boolean("allow_substs", false).perform(nothing);
    return;
  }
  if (fields.has("allow_substs")) {
    throw LaunchError("allow_substs can only be used with from", fields.where("allow_substs"),
                      "substitutions in a value are always performed", Finding::kExclusive);
  }
  tree_ = parse_tree(fields);
}

Parameters::Tree Parameters::parse_tree(const Fields& fields) {
  if (!fields.has("name")) {
    throw LaunchError("param entity should have a name or a from attribute", fields.where(),
                      "write name and value, or from=\"FILE\"", Finding::kMissingAttribute);
  }
  Tree tree{fields.text("name"), std::nullopt, {}, {}, {}, {}};
  const std::vector<const Fields*> nested = fields.items("param");
  if (fields.has("value") && !nested.empty()) {
    throw LaunchError("nested parameters and value attributes are mutually exclusive", fields.where("value"),
                      "the name of a nested parameter is made of those of all levels, with dots between them",
                      Finding::kExclusive);
  }
  if (!fields.has("value") && nested.empty()) {
    throw LaunchError("either a value attribute or nested params are needed", fields.where(),
                      "an empty text is written value=\"\"", Finding::kMissingAttribute);
  }
  if (!nested.empty()) {
    if (fields.has("type")) {
      throw LaunchError("type can't be used with nested parameters", fields.where("type"),
                        "write it in the nested ones", Finding::kExclusive);
    }
    for (const Fields* child : nested) {
      tree.nested.push_back(parse_tree(*child));
    }
    return tree;
  }
  if (const Scalar* const scalar = fields.value("value").scalar(); scalar != nullptr && fields.has("value-sep")) {
    tree.text = scalar->text.text();
    tree.separator = fields.literal("value-sep");
    tree.where = fields.where("value-sep");
  }
  tree.value.emplace(fields.value("value"), fields.literal("type"),
                     fields.has("value-sep") ? std::optional(fields.literal("value-sep")) : std::nullopt,
                     fields.where("type"));
  return tree;
}

void Parameters::perform_tree(const Tree& tree, const std::string& prefix, Scope& scope,
                              std::vector<NamedParameter>& parameters) {
  const std::string name = prefix + tree.name.perform(scope);
  if (tree.value) {
    parameters.push_back({name, tree.value->perform(scope)});
    return;
  }
  // The name is empty for a whole file: its parameters have no prefix.
  for (const Tree& child : tree.nested) {
    perform_tree(child, name.empty() ? name : name + ".", scope, parameters);
  }
}

void Parameters::find_useless_separators(const Tree& tree, LaunchContext& context) {
  if (!tree.separator.empty()) {
    find_useless_separator(tree.text, tree.separator, tree.where, context);
  }
  for (const Tree& child : tree.nested) {
    find_useless_separators(child, context);
  }
}

// The text of the file on the machine of the scope.
std::string Parameters::text_there(const std::string& path, LaunchContext& context) const {
  try {
    return context.scope().machine->read_file(path);
  } catch (const std::runtime_error& error) {
    throw LaunchError(error.what(), file_->where(),
                      "$(find-pkg-share PACKAGE)/… leads to the file of the package there",
                      Finding::kMissingParameterFile);
  }
}

std::string Parameters::performed_file(const std::string& path, LaunchContext& context) const {
  Scope& scope = context.scope();
  std::error_code ignored;
  if (scope.machine == nullptr && !std::filesystem::is_regular_file(path, ignored)) {
    throw LaunchError(fmt::format("parameter file path is not a file: {}", path), file_->where(),
                      help_for_missing_file(path), Finding::kMissingParameterFile);
  }
  const auto file = scope.machine == nullptr ? read_source_file(path, file_->where())
                                             : std::make_shared<const SourceFile>(path, text_there(path, context));
  if (scope.note_performed_file) {
    scope.note_performed_file(file);
  }
  if (context.exploration().is_on()) {
    find_lost_backslash(file, context);
  }
  const SourceRange whole{file, 0, static_cast<std::uint32_t>(file->text().size())};
  LocatedText performed(parse_template(LocatedText(file->text(), whole)).perform(scope));
  std::vector<Diagnostic> duplicate_keys;  // a node takes the last one
  try {
    read_yaml(performed, duplicate_keys);
  } catch (const LaunchError& error) {
    throw LaunchError(fmt::format("parameter file '{}' is not YAML after its substitutions: {}", path,
                                  error.diagnostics().front().message),
                      file_->where(), "substitutions are replaced by text, and backslashes go: '\\\\' stands for one",
                      Finding::kWrongParameterFile);
  }
  return performed.text();
}

void Parameters::append_to(std::vector<NamedParameter>& parameters, LaunchContext& context,
                           const KnownNodeName& node) const {
  Scope& scope = context.scope();
  if (tree_) {
    find_useless_separators(*tree_, context);
    perform_tree(*tree_, "", scope, parameters);
    return;
  }
  const std::string path = file_->perform(scope);
  if (scope.machine != nullptr && !scope.machine->is_connected()) {
    return;  // a plan does not know what is in it
  }
  std::string text = allow_substitutions_ ? performed_file(path, context) : std::string();
  if (scope.machine != nullptr && !allow_substitutions_) {
    text = text_there(path, context) + "\n";
  }
  append_parameter_file({path, file_->where(), node, false, std::move(text)}, context, parameters);
}

void Parameters::append_to(ProcessSpec& spec, LaunchContext& context, const std::string& qualified_name,
                           NodeDescription& node) const {
  Scope& scope = context.scope();
  std::string content;
  if (tree_) {
    find_useless_separators(*tree_, context);
    std::vector<NamedParameter> parameters;
    perform_tree(*tree_, "", scope, parameters);
    content.reserve(kUsualContent);
    content.append(qualified_name.empty() ? "/**" : qualified_name).append(":\n  ros__parameters:\n");
    for (const NamedParameter& parameter : parameters) {
      content.append("    ").append(quote_yaml_if_needed(parameter.name));
      content.append(": ").append(to_yaml(parameter.value)).append("\n");
    }
    node.value_files.push_back(spec.files.size());
    std::ranges::move(parameters, std::back_inserter(node.parameters));
  } else {
    const std::string path = file_->perform(scope);
    if (!allow_substitutions_) {
      std::error_code ignored;
      if (scope.machine != nullptr) {
        spec.argv.insert(spec.argv.end(), {"--params-file", path});
        context.machines().expect_file(
            scope.machine, path, file_->where(), [this, path, &context, machine = scope.machine->name()] {
              context.message(LogLevel::kWarning, "launch_ros.actions.node",
                              fmt::format("{}: parameter file path is not a file on machine '{}': {}",
                                          to_string(file_->where()), machine, path));
            });
      } else if (std::filesystem::is_regular_file(path, ignored)) {
        spec.argv.insert(spec.argv.end(), {"--params-file", path});
        find_faults_of_parameter_file({path, file_->where(), known_node_name(spec.argv)}, context);
      } else {
        context.exploration().remark({Severity::kError, fmt::format("parameter file '{}' does not exist", path),
                                      file_->where(), help_for_missing_file(path), Finding::kMissingParameterFile});
        context.message(LogLevel::kWarning, "launch_ros.actions.node",
                        fmt::format("{}: parameter file path is not a file: {}", to_string(file_->where()), path));
      }
      return;
    }
    content = performed_file(path, context);
    find_faults_of_parameter_file({path, file_->where(), known_node_name(spec.argv), false, content}, context);
  }
  spec.argv.push_back("--params-file");
  spec.files.push_back({spec.argv.size(), "launch_params.yaml", std::move(content)});
  spec.argv.push_back("");  // the path of the generated file, which is known when the file is written
}

}  // namespace launch
