// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/recorded_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

#include "actions/parameters/node_pattern.hpp"
#include "actions/parameters/parameter_reader.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "launcher/plan/node_names.hpp"

namespace launch {

namespace {

constexpr std::string_view kQosOverrides = "qos_overrides.";  // a node declares them only when they are given

ParameterSections sections_of(const std::string& path) {
  const auto file = read_source_file(path);
  const std::string text(file->text());
  return read_parameter_sections(LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())}));
}

class UnknownParameters {
 public:
  UnknownParameters(const RecordedParameters& recorded, const std::function<void(Diagnostic)>& report)
      : recorded_(recorded), report_(report) {}

  void find(const LaunchPlan& plan) const {
    for (const NodeDescription& node : plan.nodes) {
      if (node.name) {
        find_of_process(joined_name(node.name_space.value_or("/"), *node.name), plan.processes[node.process]);
      }
    }
    for (const LoadRequest& load : plan.loads) {
      for (const ComposableNode& node : load.nodes) {
        for (const NamedParameter& parameter : node.parameters) {
          check(joined_name(node.name_space, node.name), parameter.name, node.origin);
        }
      }
    }
    std::for_each(plan.reactions.begin(), plan.reactions.end(), [this](const LaunchPlan& reaction) { find(reaction); });
  }

 private:
  void check(const std::string& node, const std::string& parameter, const SourceRange& where) const {
    const auto known = recorded_.find(node);
    if (known == recorded_.end() || known->second.contains(parameter) || parameter.starts_with(kQosOverrides)) {
      return;
    }
    report_({Severity::kWarning, fmt::format("node '{}' had no parameter '{}' when it was dumped", node, parameter),
             where, did_you_mean(parameter, std::vector<std::string>(known->second.begin(), known->second.end())),
             Finding::kUnknownParameter});
  }

  void find_of_process(const std::string& node, const ProcessSpec& spec) const {
    if (!recorded_.contains(node)) {
      return;
    }
    for (const GeneratedFile& file : spec.files) {
      for (const ParameterSection& section : read_parameter_sections(LocatedText(file.content)).sections) {
        if (is_for_node(section.pattern, node)) {
          for (const FileParameter& parameter : section.parameters) {
            check(node, parameter.name, spec.origin);
          }
        }
      }
    }
    const auto ros_words = std::find(spec.argv.begin(), spec.argv.end(), "--ros-args");
    for (auto word = ros_words; word != spec.argv.end() && std::next(word) != spec.argv.end(); ++word) {
      if (*word == "-p" || *word == "--param") {
        find_of_word(node, *std::next(word), spec);
      } else if (*word == "--params-file" && !is_generated(spec, std::next(word))) {
        find_of_file(node, *std::next(word));
      }
    }
  }

  static bool is_generated(const ProcessSpec& spec, std::vector<std::string>::const_iterator word) {
    const auto index = static_cast<std::size_t>(word - spec.argv.begin());
    return std::any_of(spec.files.begin(), spec.files.end(),
                       [index](const GeneratedFile& file) { return file.argument == index; });
  }

  // "name:=value", or "node:name:=value".
  void find_of_word(const std::string& node, const std::string& word, const ProcessSpec& spec) const {
    const std::size_t end = word.find(":=");
    const std::size_t begin = word.rfind(':', end == 0 ? 0 : end - 1);
    if (end != std::string::npos) {
      check(node, begin == std::string::npos ? word.substr(0, end) : word.substr(begin + 1, end - begin - 1),
            spec.origin);
    }
  }

  void find_of_file(const std::string& node, const std::string& path) const {
    try {
      for (const ParameterSection& section : sections_of(path).sections) {
        if (section.pattern.find('*') == std::string::npos && is_for_node(section.pattern, node)) {
          for (const FileParameter& parameter : section.parameters) {
            check(node, parameter.name, parameter.name_where);
          }
        }
      }
    } catch (const LaunchError&) {
      // A file that can't be read is another finding.
    }
  }

  const RecordedParameters& recorded_;
  const std::function<void(Diagnostic)>& report_;
};

}  // namespace

void read_recorded_parameters(const std::string& path, RecordedParameters& parameters) {
  const ParameterSections dump = sections_of(path);
  if (dump.no_yaml) {
    throw LaunchError(std::vector<Diagnostic>{*dump.no_yaml});
  }
  if (dump.sections.empty()) {
    throw LaunchError(fmt::format("'{}' holds no parameters of a node", path), {},
                      "launch param dump NODE > FILE writes them");
  }
  for (const ParameterSection& section : dump.sections) {
    std::set<std::string>& names = parameters[(section.pattern.starts_with('/') ? "" : "/") + section.pattern];
    for (const FileParameter& parameter : section.parameters) {
      names.insert(parameter.name);
    }
  }
}

void find_unknown_parameters(const LaunchPlan& plan, const RecordedParameters& recorded,
                             const std::function<void(Diagnostic)>& report) {
  UnknownParameters(recorded, report).find(plan);
}

}  // namespace launch
