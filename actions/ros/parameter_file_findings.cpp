// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/parameter_file_findings.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/yaml_document.hpp"

namespace launch {

namespace {

constexpr const char* kSection = "ros__parameters";

// The first fault of a mapping above `ros__parameters`, whose keys are parts of the names of nodes.
std::optional<Diagnostic> fault_of(const YamlNode& nodes, bool top) {
  for (const YamlEntry& entry : nodes.entries) {
    const std::string& key = entry.key.scalar.text.text();
    const bool is_mapping = entry.value.kind == YamlNode::Kind::kMapping;
    const auto fault = [&](std::string message, std::string help) {
      return Diagnostic{Severity::kError, std::move(message), entry.key.where, std::move(help),
                        Finding::kWrongParameterFile};
    };
    if (key == kSection) {
      if (top) {
        return fault("ros__parameters stands below no name of a node", "for all nodes write /**: above it");
      }
      continue;
    }
    if (std::string help = did_you_mean(key, std::vector<std::string>{kSection}); !help.empty()) {
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
