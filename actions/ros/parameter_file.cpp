// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/parameter_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/yaml_document.hpp"
#include "launcher/language/parameter_value.hpp"

namespace launch {

namespace {

constexpr std::string_view kParameters = "ros__parameters";

// "/a/b" and "a/b" have the parts a and b.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin < name.size()) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    if (end > begin) {
      parts.push_back(name.substr(begin, end - begin));
    }
    begin = end + 1;
  }
  return parts;
}

// "*" stands for one part, "**" for any number.
bool matches(std::span<const std::string> pattern, std::span<const std::string> name) {
  if (pattern.empty()) {
    return name.empty();
  }
  if (pattern.front() == "**") {
    return matches(pattern.subspan(1), name) || (!name.empty() && matches(pattern, name.subspan(1)));
  }
  return !name.empty() && (pattern.front() == "*" || pattern.front() == name.front()) &&
         matches(pattern.subspan(1), name.subspan(1));
}

// Calls `found` with the pattern and the value of each `ros__parameters` section.
void each_section(const YamlNode& node, const std::string& pattern,
                  const std::function<void(const std::string&, const YamlNode&)>& found) {
  for (const YamlEntry& entry : node.entries) {
    if (entry.key.scalar.text.text() == kParameters) {
      found(pattern, entry.value);
    } else if (entry.value.kind == YamlNode::Kind::kMapping) {
      each_section(entry.value, pattern + "/" + entry.key.scalar.text.text(), found);
    }
  }
}

Value to_value(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::kScalar) {
    return {node.scalar, node.where};
  }
  std::vector<Value> items;
  for (const YamlNode& item : node.items) {
    items.push_back(to_value(item));
  }
  return {std::move(items), node.where};
}

void append_node(const YamlNode& node, const std::string& name, std::vector<NamedParameter>& parameters) {
  if (node.kind == YamlNode::Kind::kMapping) {
    for (const YamlEntry& entry : node.entries) {
      append_node(entry.value, name + "." + entry.key.scalar.text.text(), parameters);
    }
  } else {
    parameters.push_back({name, parameter_of(to_value(node))});
  }
}

// The first fault of a mapping above `ros__parameters`, whose keys are parts of the names of nodes.
std::optional<Diagnostic> fault_of(const YamlNode& nodes, bool top) {
  for (const YamlEntry& entry : nodes.entries) {
    const std::string& key = entry.key.scalar.text.text();
    const bool is_mapping = entry.value.kind == YamlNode::Kind::kMapping;
    const auto fault = [&](std::string message, std::string help) {
      return Diagnostic{Severity::kError, std::move(message), entry.key.where, std::move(help),
                        Finding::kWrongParameterFile};
    };
    if (key == kParameters) {
      if (top) {
        return fault("ros__parameters stands below no name of a node", "for all nodes write /**: above it");
      }
      continue;
    }
    if (std::string help = did_you_mean(key, std::vector<std::string>{std::string(kParameters)}); !help.empty()) {
      return fault(fmt::format("'{}' stands where ros__parameters is expected", key), std::move(help));
    }
    if (!is_mapping && !entry.value.is_null()) {
      return fault(fmt::format("'{}' stands outside of ros__parameters", key),
                   "parameters stand below NODE: ros__parameters:");
    }
    if (is_mapping) {
      if (std::optional<Diagnostic> below = fault_of(entry.value, false)) {
        return below;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

void append_parameter_text(const LocatedText& text, const std::string& full_name,
                           std::vector<NamedParameter>& parameters) {
  std::vector<Diagnostic> duplicate_keys;  // the last one counts
  const YamlNode root = read_yaml(text, duplicate_keys);
  if (root.is_null()) {
    return;
  }
  if (root.kind != YamlNode::Kind::kMapping) {
    throw LaunchError(fmt::format("expected a mapping of parameters, got {}", describe(root)), root.where, {},
                      Finding::kWrongParameterFile);
  }
  // A later section replaces a parameter of an earlier one in its place.
  std::vector<YamlEntry> chosen;
  bool any_section = false;
  const std::vector<std::string> name = parts_of(full_name);
  each_section(root, "", [&](const std::string& pattern, const YamlNode& section) {
    any_section = true;
    if (!matches(parts_of(pattern), name)) {
      return;
    }
    for (const YamlEntry& entry : section.entries) {
      const auto same = std::find_if(chosen.begin(), chosen.end(), [&](const YamlEntry& other) {
        return other.key.scalar.text.text() == entry.key.scalar.text.text();
      });
      if (same == chosen.end()) {
        chosen.push_back(entry);
      } else {
        same->value = entry.value;
      }
    }
  });
  for (const YamlEntry& entry : any_section ? chosen : root.entries) {
    append_node(entry.value, entry.key.scalar.text.text(), parameters);
  }
}

void append_parameter_file(const std::string& path, const std::string& full_name, const SourceRange& where,
                           std::vector<NamedParameter>& parameters) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw LaunchError(fmt::format("parameter file path is not a file: {}", path), where, help_for_missing_file(path),
                      Finding::kMissingParameterFile);
  }
  const auto file = read_source_file(path, where);
  try {
    append_parameter_text(LocatedText(file->text(), {file, 0, static_cast<std::uint32_t>(file->text().size())}),
                          full_name, parameters);
  } catch (const LaunchError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& diagnostic : diagnostics) {
      diagnostic.finding = Finding::kWrongParameterFile;  // whatever kind it is in a launch file
    }
    throw LaunchError(std::move(diagnostics));
  }
}

void find_faults_of_parameter_file(const std::string& path, const SourceRange& where, LaunchContext& context) {
  if (!context.exploration().is_on() || !context.exploration().sees_first(path)) {
    return;
  }
  try {
    const auto file = read_source_file(path, where);
    std::vector<Diagnostic> duplicate_keys;  // the last one counts
    const YamlNode root = read_yaml(
        LocatedText(file->text(), {file, 0, static_cast<std::uint32_t>(file->text().size())}), duplicate_keys);
    if (root.is_null()) {
      return;
    }
    if (root.kind != YamlNode::Kind::kMapping) {
      context.exploration().remark({Severity::kError,
                                    fmt::format("expected a mapping of nodes, got {}", describe(root)), root.where,
                                    "parameters stand below NODE: ros__parameters:", Finding::kWrongParameterFile});
    } else if (std::optional<Diagnostic> fault = fault_of(root, true)) {
      context.exploration().remark(std::move(*fault));
    }
  } catch (YamlSyntaxError& error) {
    error.classify(Finding::kWrongParameterFile);
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      context.exploration().remark(diagnostic);
    }
  } catch (const LaunchError&) {
    // What this reader refuses although it is YAML, a node may read.
  }
}

}  // namespace launch
