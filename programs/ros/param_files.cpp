// SPDX-License-Identifier: Apache-2.0
// launch param dump, load
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>

#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/yaml_text.hpp"
#include "programs/rclcpp_versions/rclcpp_versions.hpp"
#include "programs/ros/parameter_verb.hpp"

namespace launch {

namespace {

// Parameters as a tree: "a.b" is the member b of a.
struct ParameterTree {
  std::map<std::string, ParameterTree> members;
  std::string yaml;  // of a leaf: the lines behind its name

  void insert(const std::string& name, std::string value) {
    const std::size_t point = name.find('.');
    if (point == std::string::npos) {
      members[name].yaml = std::move(value);
    } else {
      members[name.substr(0, point)].insert(name.substr(point + 1), std::move(value));
    }
  }

  std::string text(std::size_t depth) const {
    std::string lines;
    const std::string indent(2 * depth, ' ');
    for (const auto& [name, member] : members) {
      lines += indent + yaml_text(name, false) + ":";
      if (!member.yaml.empty()) {
        lines += member.leaf(indent);
      }
      lines += member.members.empty() ? "" : (member.yaml.empty() ? "\n" : "") + member.text(depth + 1);
    }
    return lines;
  }

 private:
  // " 3\n", or the items of a list below each other.
  std::string leaf(const std::string& indent) const {
    if (!yaml.starts_with("- ")) {
      return " " + yaml;
    }
    std::string lines = "\n";
    for (std::size_t begin = 0; begin < yaml.size();) {
      const std::size_t end = yaml.find('\n', begin) + 1;
      lines += indent + yaml.substr(begin, end - begin);
      begin = end;
    }
    return lines;
  }
};

class ParamDump final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override { declare_node(app); }

  int run() override {
    GraphSession session;
    const std::string node = find_node(session);
    const std::vector<std::string> names = parameter_names(session, node, {});
    const std::vector<ParameterReading> values = parameter_values(session, node, names);
    ParameterTree tree;
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) {
      tree.insert(names[i], values[i].type == 0 ? "null\n" : to_yaml(values[i].field, values[i].value));
    }
    put(fmt::format("{}:\n  ros__parameters:{}\n", node, tree.members.empty() ? " {}\n" : "\n" + tree.text(2)));
    return 0;
  }
};

class ParamLoad final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app);
    app.add_option("file", file_, "parameter file")->required()->check(CLI::ExistingFile);
    app.add_flag("--no-use-wildcard", no_wildcard_, "leave out the parameters of '/**'");
  }

  int run() override {
    GraphSession session;
    const std::string node = find_node(session);
    const auto all = rclcpp_versions::parameters_of_file(file_, no_wildcard_ ? nullptr : node.c_str());
    const auto own = all.find(node);
    if (own == all.end() || own->second.empty()) {
      throw CommandError(fmt::format("'{}' has no parameters for node '{}'", file_, node));
    }
    int exit_code = 0;
    for (const rclcpp::Parameter& parameter : own->second) {
      const std::string& name = parameter.get_name();
      const SetResult result = set_parameter(session, node, name, value_yaml(parameter));
      exit_code |= report(result, fmt::format("Set parameter {} successful", name),
                          fmt::format("Set parameter {} failed", name));
    }
    return exit_code;
  }

 private:
  template <typename List, typename ToText>
  static std::string list(int type, const char* kind, const List& values, const ToText& to_text) {
    std::vector<std::string> items;
    for (const auto& value : values) {
      items.push_back(to_text(value));
    }
    return fmt::format("{{type: {}, {}_array_value: [{}]}}", type, kind, fmt::join(items, ", "));
  }

  static std::string value_yaml(const rclcpp::Parameter& parameter) {
    switch (parameter.get_type()) {
      case rclcpp::ParameterType::PARAMETER_BOOL:
        return fmt::format("{{type: 1, bool_value: {}}}", parameter.as_bool());
      case rclcpp::ParameterType::PARAMETER_INTEGER:
        return fmt::format("{{type: 2, integer_value: {}}}", parameter.as_int());
      case rclcpp::ParameterType::PARAMETER_DOUBLE:
        return fmt::format("{{type: 3, double_value: {}}}", python_float(parameter.as_double()));
      case rclcpp::ParameterType::PARAMETER_STRING:
        return fmt::format("{{type: 4, string_value: {}}}", yaml_text(parameter.as_string(), true));
      case rclcpp::ParameterType::PARAMETER_BYTE_ARRAY:
        return list(5, "byte", parameter.as_byte_array(), [](std::uint8_t byte) { return fmt::to_string(+byte); });
      case rclcpp::ParameterType::PARAMETER_BOOL_ARRAY:
        return list(6, "bool", parameter.as_bool_array(), [](bool flag) { return flag ? "true" : "false"; });
      case rclcpp::ParameterType::PARAMETER_INTEGER_ARRAY:
        return list(7, "integer", parameter.as_integer_array(),
                    [](std::int64_t value) { return fmt::to_string(value); });
      case rclcpp::ParameterType::PARAMETER_DOUBLE_ARRAY:
        return list(8, "double", parameter.as_double_array(), python_float);
      case rclcpp::ParameterType::PARAMETER_STRING_ARRAY:
        return list(9, "string", parameter.as_string_array(),
                    [](const std::string& text) { return yaml_text(text, true); });
      default:
        return "{type: 0}";
    }
  }

  std::string file_;
  bool no_wildcard_ = false;
};

}  // namespace

std::vector<VerbInfo> param_file_verbs() {
  return {{"param", "dump", "prints all parameters of a node as a parameter file", make_verb<ParamDump>},
          {"param", "load", "sets the parameters of a parameter file", make_verb<ParamLoad>}};
}

}  // namespace launch
