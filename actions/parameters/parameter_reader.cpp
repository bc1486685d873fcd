// SPDX-License-Identifier: Apache-2.0
#include "actions/parameters/parameter_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <rcl_yaml_param_parser/typed_scalar.hpp>
#include <stdexcept>
#include <utility>

#include "actions/parameters/node_pattern.hpp"
#include "actions/parameters/parameter_tree.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/yaml_events.hpp"

namespace launch {

namespace {

constexpr std::string_view kParameters = "ros__parameters";
// As deep as yaml-cpp lets brackets nest. Aliases must not nest deeper.
constexpr std::size_t kMaximumDepth = 500;

class SectionReader {
  using Kind = ParameterTree::Kind;
  using Node = ParameterTree::Node;
  using Text = ParameterTree::Text;

 public:
  SectionReader(const LocatedText& source, const YamlEvents& events, ParameterSections& found)
      : tree_(source, events,
              [this](const SourceRange& where) {
                refuse("a node reads no aliases", where, "write the value itself in place of the alias");
              }),
        found_(found) {}

  void read() {
    if (tree_.is_empty()) {
      return;
    }
    const Node root = tree_.root();
    if (tree_.kind(root) != Kind::kMapping) {
      refuse(fmt::format("expected a mapping of nodes, got {}",
                         tree_.kind(root) == Kind::kSequence ? "a list" : "a value"),
             tree_.place(root), "parameters stand below NODE: ros__parameters:");
      return;
    }
    read_nodes(root, "", {});
    if (found_.sections.empty() && !has_parameters_key_) {
      found_.bare.emplace();
      found_.bare->where = tree_.place(root);
      read_parameters(root, "", *found_.bare);
    }
  }

 private:
  static Diagnostic fault(std::string message, const SourceRange& where, std::string help) {
    return {Severity::kError, std::move(message), where, std::move(help), Finding::kWrongParameterFile};
  }

  // A node ends at the first fault.
  void refuse(std::string message, const SourceRange& where, std::string help) {
    if (!found_.node_refuses) {
      found_.node_refuses = fault(std::move(message), where, std::move(help));
    }
  }

  void enter(Node mapping) {
    if (++depth_ > kMaximumDepth) {
      throw LaunchError(fmt::format("the aliases nest more than {} levels deep", kMaximumDepth), tree_.place(mapping));
    }
  }

  // A mapping above ros__parameters: its keys are parts of the names of nodes.
  void read_nodes(Node mapping, const std::string& prefix, const SourceRange& prefix_where) {
    enter(mapping);
    for (const auto& [key, content] : tree_.entries_of(mapping)) {
      if (!tree_.is_value(key) || tree_.key_of(key).text.empty()) {
        refuse("the name of a node must be a text", tree_.place(key), "");
        continue;
      }
      const Text name = tree_.key_of(key);
      if (name.text.starts_with(kParameters)) {
        has_parameters_key_ = true;
        read_section(prefix, prefix_where, name, content);
        continue;
      }
      if (std::string help = did_you_mean(name.text, {std::string(kParameters)}); !help.empty()) {
        refuse(fmt::format("'{}' stands where ros__parameters is expected", name.text), name.where, std::move(help));
      } else if (tree_.kind(content) != Kind::kMapping) {
        refuse(fmt::format("'{}' stands outside of ros__parameters", name.text), name.where,
               "parameters stand below NODE: ros__parameters:");
      } else {
        read_nodes(content, prefix + (prefix.empty() || prefix.ends_with('/') ? "" : "/") + name.text, name.where);
      }
    }
    --depth_;
  }

  void read_section(const std::string& pattern, const SourceRange& pattern_where, const Text& key, Node content) {
    if (pattern.empty()) {
      refuse("ros__parameters stands below no name of a node", key.where, "for all nodes write /**: above it");
      return;
    }
    if (!is_valid_node_pattern(pattern)) {
      refuse(fmt::format("'{}' is no name of a node", pattern), pattern_where,
             "parts of letters, digits and underscores, not starting with a digit, with single slashes between; * "
             "stands for one part, ** for any number");
    }
    if (tree_.kind(content) != Kind::kMapping) {
      refuse("ros__parameters must hold parameters as NAME: VALUE", key.where,
             "write {} for none, or leave out the name of the node");
      return;
    }
    ParameterSection& section = found_.sections.emplace_back();
    section.pattern = pattern;
    section.where = pattern_where;
    read_parameters(content, "", section);
  }

  void read_parameters(Node mapping, const std::string& prefix, ParameterSection& section) {
    enter(mapping);
    check_tag(mapping, "map", section);
    for (const auto& [key, content] : tree_.entries_of(mapping)) {
      if (!tree_.is_value(key) || tree_.key_of(key).text.empty()) {
        section.errors.push_back(fault("the name of a parameter must be a text", tree_.place(key), ""));
        continue;
      }
      const Text key_text = tree_.key_of(key);
      const std::string name = prefix + key_text.text;
      if (tree_.kind(content) == Kind::kMapping) {
        read_parameters(content, name + ".", section);
        continue;
      }
      FileParameter parameter{name, {}, key_text.where, tree_.place(content)};
      const std::size_t errors = section.errors.size();
      parameter.value = tree_.kind(content) == Kind::kSequence ? read_list(content, parameter, section)
                                                               : value_of(read_scalar(content, parameter, section));
      if (section.errors.size() == errors) {
        section.parameters.push_back(std::move(parameter));
      }
    }
    --depth_;
  }

  // A list or a mapping can only have the tag of its kind.
  void check_tag(Node node, std::string_view expected, ParameterSection& section) const {
    constexpr std::string_view kStandard = "tag:yaml.org,2002:";
    const std::string_view tag = tree_.tag(node);
    if (tag.size() > 1 && (!tag.starts_with(kStandard) || tag.substr(kStandard.size()) != expected)) {
      const bool is_standard = tag.starts_with(kStandard);
      section.errors.push_back(
          fault(fmt::format("the tag '{}{}' does not fit {}", is_standard ? "!!" : "",
                            tag.substr(is_standard ? kStandard.size() : 0), expected == "seq" ? "a list" : "a mapping"),
                tree_.place(node), "remove the tag"));
    }
  }

  rcl_yaml::Scalar read_scalar(Node node, FileParameter& parameter, ParameterSection& section) const {
    const Text text = tree_.text_of(node);
    if (text.text.empty() && !text.is_quoted) {
      section.errors.push_back(fault(fmt::format("parameter '{}' has no value", parameter.name),
                                     text.where.begin == text.where.end ? parameter.name_where : text.where,
                                     "an empty text is written \"\""));
      return {};
    }
    try {
      rcl_yaml::Scalar value = rcl_yaml::typed_scalar(text.text, {text.is_quoted, text.tag});
      if (!parameter.ros2_component && tree_.kind(node) == Kind::kNull) {
        parameter.ros2_component = differs(text, "a string", "nothing, so that the component is not loaded");
      } else if (!parameter.ros2_component && tree_.is_plain(node)) {
        compare_with_yaml11(text, value, parameter);
      }
      return value;
    } catch (const std::invalid_argument& error) {
      section.errors.push_back(
          fault(fmt::format("parameter '{}': {}", parameter.name, error.what()), text.where, "remove the tag"));
      return {};
    }
  }

  static Diagnostic differs(const Text& text, std::string_view here, std::string_view in_ros2) {
    return {Severity::kWarning, fmt::format("'{}' is {}; for a component, ROS 2 makes it {}", text.text, here, in_ros2),
            text.where, "write it so that YAML 1.1 has the same type: 1.0e-5, .nan, true, or a text in quotes",
            Finding::kOtherInRos2};
  }

  // ROS 2 reads the files of components with PyYAML.
  static void compare_with_yaml11(const Text& text, const rcl_yaml::Scalar& value, FileParameter& parameter) {
    Scalar other;
    other.text = LocatedText(text.text);
    set_yaml11_type(other);
    const auto differ = [&](std::string_view in_ros2) {
      parameter.ros2_component = differs(text, rcl_yaml::type_name(value), in_ros2);
    };
    switch (other.type) {
      case Scalar::Type::kBool:
        if (value != rcl_yaml::Scalar(other.bool_value)) {
          differ("a bool");
        }
        break;
      case Scalar::Type::kInt:
        if (value != rcl_yaml::Scalar(other.int_value)) {
          differ(fmt::format("the integer {}", other.int_value));
        }
        break;
      case Scalar::Type::kFloat:
        if (!std::holds_alternative<double>(value)) {
          differ(fmt::format("the double {}", other.float_value));
        }
        break;
      case Scalar::Type::kString:
      case Scalar::Type::kUntyped:
        if (!std::holds_alternative<std::string>(value)) {
          differ("a string");
        }
        break;
      case Scalar::Type::kNull:
      case Scalar::Type::kOther:
        differ("a date, so that the component is not loaded");
        break;
    }
  }

  static ParameterValue value_of(const rcl_yaml::Scalar& scalar) {
    if (const auto* const bytes = std::get_if<rcl_yaml::Bytes>(&scalar)) {
      return bytes_of(*bytes);
    }
    return item_of(scalar);
  }

  static std::vector<ParameterScalar> bytes_of(const rcl_yaml::Bytes& bytes) {
    std::vector<ParameterScalar> items;
    for (const std::uint8_t byte : bytes) {
      items.emplace_back(std::byte{byte});
    }
    return items;
  }

  static ParameterScalar item_of(const rcl_yaml::Scalar& scalar) {
    if (const auto* const boolean = std::get_if<bool>(&scalar)) {
      return *boolean;
    }
    if (const auto* const integer = std::get_if<std::int64_t>(&scalar)) {
      return *integer;
    }
    if (const auto* const real = std::get_if<double>(&scalar)) {
      return *real;
    }
    return std::get<std::string>(scalar);
  }

  ParameterValue read_list(Node list, FileParameter& parameter, ParameterSection& section) {
    check_tag(list, "seq", section);
    std::vector<ParameterScalar> items;
    std::optional<rcl_yaml::Scalar> first;
    for (const Node content : tree_.items_of(list)) {
      if (!tree_.is_value(content)) {
        section.errors.push_back(fault(
            fmt::format("the list of parameter '{}' holds {}", parameter.name,
                        tree_.kind(content) == Kind::kSequence ? "a list" : "a mapping"),
            tree_.place(content), "a parameter is a bool, an integer, a double, a string, or a list of one of these"));
        return {};
      }
      const std::size_t errors = section.errors.size();
      const rcl_yaml::Scalar value = read_scalar(content, parameter, section);
      if (section.errors.size() > errors) {
        return {};
      }
      first = first.value_or(value);
      if (first->index() != value.index()) {
        const bool numbers = first->index() + value.index() == 3 && first->index() != 0 && value.index() != 0;
        Diagnostic mixed = fault(
            fmt::format("the list of parameter '{}' must be of one type: it begins with {} and has {}", parameter.name,
                        rcl_yaml::type_name(*first), rcl_yaml::type_name(value)),
            tree_.place(content), numbers ? "give each number a point: 1.0" : "in quotes, all of them are strings");
        if (std::optional<ParameterValue> other = yaml11_list(list)) {
          section.node_errors.push_back(std::move(mixed));
          return *std::move(other);
        }
        section.errors.push_back(std::move(mixed));
        return {};
      }
      if (const auto* const bytes = std::get_if<rcl_yaml::Bytes>(&value)) {
        const std::vector<ParameterScalar> more = bytes_of(*bytes);
        items.insert(items.end(), more.begin(), more.end());
      } else {
        items.push_back(item_of(value));
      }
    }
    return items;
  }

  // A list that is mixed for a node, such as [x, y], may be of one type by the rules with which ROS 2 reads the files
  // of components.
  std::optional<ParameterValue> yaml11_list(Node list) {
    std::vector<ParameterScalar> items;
    for (const Node item : tree_.items_of(list)) {
      const std::optional<ParameterScalar> value = yaml11_scalar(item);
      if (!value || (!items.empty() && items.front().index() != value->index())) {
        return std::nullopt;
      }
      items.push_back(*value);
    }
    return items;
  }

  std::optional<ParameterScalar> yaml11_scalar(Node node) const {
    if (tree_.kind(node) != Kind::kScalar) {
      return std::nullopt;
    }
    Scalar scalar;
    scalar.text = LocatedText(tree_.text_of(node).text);
    if (!tree_.is_plain(node)) {
      return tree_.text_of(node).tag.size() > 1 ? std::nullopt : std::optional<ParameterScalar>(scalar.text.text());
    }
    set_yaml11_type(scalar);
    switch (scalar.type) {
      case Scalar::Type::kBool:
        return scalar.bool_value;
      case Scalar::Type::kInt:
        return scalar.int_value;
      case Scalar::Type::kFloat:
        return scalar.float_value;
      case Scalar::Type::kString:
        return scalar.text.text();
      default:
        return std::nullopt;
    }
  }

  ParameterTree tree_;
  ParameterSections& found_;
  std::size_t depth_ = 0;
  bool has_parameters_key_ = false;
};

}  // namespace

bool FileParameter::is_empty_list() const {
  const auto* const list = std::get_if<std::vector<ParameterScalar>>(&value);
  return list != nullptr && list->empty();
}

ParameterSections read_parameter_sections(const LocatedText& text) {
  ParameterSections found;
  try {
    if (std::optional<Diagnostic> bad = find_bad_character(text)) {
      throw LaunchError(std::vector<Diagnostic>{std::move(*bad)});
    }
    const YamlStream stream = read_yaml_events(text);
    // What is found here comes first in the file, before the place where yaml-cpp gave up.
    ParameterSections before_error;
    SectionReader(text, stream.document, stream.error ? before_error : found).read();
    if (stream.error) {
      throw LaunchError(std::vector<Diagnostic>{*stream.error});
    }
    if (!stream.second_document.list.empty()) {
      SectionReader(text, stream.second_document, found).read();
    }
  } catch (const LaunchError& error) {
    found = {};
    found.no_yaml = error.diagnostics().front();
    found.no_yaml->finding = Finding::kWrongParameterFile;
  }
  return found;
}

}  // namespace launch
