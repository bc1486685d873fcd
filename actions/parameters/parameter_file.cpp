// SPDX-License-Identifier: Apache-2.0
#include "actions/parameters/parameter_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>

#include "actions/parameters/node_pattern.hpp"
#include "actions/parameters/parameter_reader.hpp"
#include "actions/values/ros_names.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "base/text/names.hpp"
#include "launcher/substitution/unrun_commands.hpp"

namespace launch {

namespace {

LocatedText text_of(const ParameterFileUse& use) {
  // A text with performed substitutions mostly has the lines of the file, and shows what a node gets.
  const auto file = use.performed.empty() ? read_source_file(use.path, use.where)
                                          : std::make_shared<const SourceFile>(use.path, use.performed, use.where);
  return LocatedText(file->text(), {file, 0, static_cast<std::uint32_t>(file->text().size())});
}

std::string full_name_of(const KnownNodeName& node) {
  return node.name ? qualified_name(node.name_space.value_or("/"), *node.name) : "";
}

// Also if it can only be for some node of the namespace, or if nothing is known of the name.
bool may_be_for(const ParameterSection& section, const KnownNodeName& node) {
  return node.name         ? is_for_node(section.pattern, full_name_of(node))
         : node.name_space ? is_for_namespace(section.pattern, *node.name_space)
                           : true;
}

std::string line_and_column(const SourceRange& where) {
  const SourceFile::Position position = where.file->position(where.begin);
  return fmt::format("line {}, column {}", position.line, position.column);
}

// A parameter that is given twice for one name of nodes.
void find_repeated(const ParameterSections& read, const Exploration& exploration) {
  std::map<std::string, std::map<std::string, SourceRange>> seen;
  for (const ParameterSection& section : read.sections) {
    auto& names = seen[section.pattern.starts_with('/') ? section.pattern : "/" + section.pattern];
    for (const FileParameter& parameter : section.parameters) {
      const auto [first, is_new] = names.emplace(parameter.name, parameter.name_where);
      if (!is_new) {
        exploration.remark({Severity::kWarning, fmt::format("parameter '{}' is given twice", parameter.name),
                            parameter.name_where,
                            fmt::format("the last value counts; the first is at {}", line_and_column(first->second)),
                            Finding::kRepeatedParameter});
      }
    }
  }
}

// "sections: a, b; did you mean …"
std::string help_for_unmatched(const ParameterSections& read, const KnownNodeName& node) {
  std::vector<std::string> patterns;
  std::vector<std::string> names;
  const std::string own = full_name_of(node);
  bool has_name = false;
  for (const ParameterSection& section : read.sections) {
    if (std::find(patterns.begin(), patterns.end(), section.pattern) == patterns.end()) {
      patterns.push_back(section.pattern);
      names.push_back(section.pattern.substr(section.pattern.rfind('/') + 1));
      has_name = has_name || names.back() == node.name;
    }
  }
  std::string help = "sections: " + list_some(patterns);
  if (has_name) {
    help += fmt::format("; did you mean '{}' or '/**/{}'?", own, *node.name);
  } else if (node.name && !nearest_name(*node.name, names).empty()) {
    help += fmt::format("; did you mean '{}'?", own);
  }
  return help;
}

bool is_matched(const ParameterSections& read, const KnownNodeName& node) {
  return read.sections.empty() || std::any_of(read.sections.begin(), read.sections.end(),
                                              [&](const auto& section) { return may_be_for(section, node); });
}

std::string whom_of(const KnownNodeName& node) {
  return node.name ? full_name_of(node) : "a node in " + *node.name_space;
}

void find_unmatched(const ParameterSections& read, const ParameterFileUse& use, Exploration& exploration) {
  const std::string key = fmt::format("{} {}", place_with_path(use.where), use.path);
  if (is_matched(read, use.node)) {
    exploration.settle(key);
    return;
  }
  Diagnostic diagnostic{Severity::kWarning, fmt::format("no section of '{}' is for {}", use.path, whom_of(use.node)),
                        use.where, help_for_unmatched(read, use.node), Finding::kUnmatchedParameterFile};
  if (use.for_many) {
    exploration.postpone(key, std::move(diagnostic));
  } else {
    exploration.remark(std::move(diagnostic));
  }
}

// A list without items has no type, and a node that gets one ends.
void find_empty_lists(const ParameterSections& read, const ParameterFileUse& use, const Exploration& exploration) {
  for (const ParameterSection& section : read.sections) {
    for (const FileParameter& parameter : section.parameters) {
      if (parameter.is_empty_list() && use.node.name && may_be_for(section, use.node)) {
        exploration.remark({Severity::kError,
                            fmt::format("parameter '{}' is an empty list, which has no type", parameter.name),
                            parameter.where, "leave it out, or give it an item", Finding::kWrongParameterFile});
      }
    }
  }
}

// In a run the node itself tells what it refuses, but it starts without a word when no section is for it.
void tell_unmatched(const ParameterFileUse& use, LaunchContext& context) {
  if (use.for_many || (!use.node.name && !use.node.name_space)) {
    return;
  }
  try {
    const ParameterSections read = read_parameter_sections(text_of(use));
    if (!read.no_yaml && !read.node_refuses && !is_matched(read, use.node)) {
      context.message(LogLevel::kWarning, "launch_ros.actions.node",
                      fmt::format("{}: no section of '{}' is for {} ({})", to_string(use.where), use.path,
                                  whom_of(use.node), help_for_unmatched(read, use.node)));
    }
  } catch (const LaunchError&) {
    // The node tells.
  }
}

// Whether the file was not judged before.
bool is_new(const ParameterFileUse& use, Exploration& exploration) {
  return exploration.sees_first(use.path + (use.performed.empty() ? "" : "\n" + use.performed));
}

}  // namespace

KnownNodeName known_node_name(const std::vector<std::string>& argv) {
  if (!argv.empty() && argv.front().find("container", argv.front().rfind('/') + 1) != std::string::npos) {
    return {};
  }
  KnownNodeName node;
  bool is_named = false;
  for (std::size_t i = 1; i < argv.size(); ++i) {
    if (argv[i - 1] != "-r" && argv[i - 1] != "--remap") {
      continue;
    }
    std::string_view rule = argv[i];
    const auto value_of = [&](std::string_view name) -> std::optional<std::string> {
      return rule.starts_with(name) ? std::optional(std::string(rule.substr(name.size()))) : std::nullopt;
    };
    if (const auto name = value_of("__node:="); name && !is_named) {
      node.name = name;
      is_named = true;
    } else if (const auto other = value_of("__name:="); other && !is_named) {
      node.name = other;
      is_named = true;
    } else if (const auto name_space = value_of("__ns:="); name_space && !node.name_space) {
      node.name_space = name_space;
    } else if (rule.find(":__node:=") != std::string_view::npos || rule.find(":__ns:=") != std::string_view::npos ||
               rule.find(":__name:=") != std::string_view::npos) {
      return {};  // for one node of several
    }
  }
  return node;
}

void append_parameter_file(const ParameterFileUse& use, LaunchContext& context,
                           std::vector<NamedParameter>& parameters) {
  std::error_code ignored;
  if (use.performed.empty() && !std::filesystem::is_regular_file(use.path, ignored)) {
    throw LaunchError(fmt::format("parameter file path is not a file: {}", use.path), use.where,
                      help_for_missing_file(use.path), Finding::kMissingParameterFile);
  }
  ParameterSections read = read_parameter_sections(text_of(use));
  if (read.no_yaml) {
    throw LaunchError(std::vector<Diagnostic>{*read.no_yaml});
  }
  Exploration& exploration = context.exploration();
  if (read.bare) {
    read.sections.push_back(std::move(*read.bare));
    read.sections.front().pattern = "/**";
  } else if (exploration.is_on()) {
    find_unmatched(read, use, exploration);
  }
  if (exploration.is_on() && is_new(use, exploration)) {
    find_repeated(read, exploration);
  }
  // A later section replaces a parameter of an earlier one in its place.
  const std::size_t begin = parameters.size();
  for (const ParameterSection& section : read.sections) {
    if (!is_for_node(section.pattern, full_name_of(use.node))) {
      continue;
    }
    if (!section.errors.empty()) {
      throw LaunchError(section.errors);
    }
    for (const FileParameter& parameter : section.parameters) {
      const auto same = std::find_if(parameters.begin() + static_cast<std::ptrdiff_t>(begin), parameters.end(),
                                     [&](const NamedParameter& other) { return other.name == parameter.name; });
      if (same == parameters.end()) {
        parameters.push_back({parameter.name, parameter.value});
      } else {
        same->value = parameter.value;
      }
      if (exploration.is_strict() && parameter.ros2_component) {
        exploration.remark(*parameter.ros2_component);
      }
    }
  }
}

void find_faults_of_parameter_file(const ParameterFileUse& use, LaunchContext& context) {
  Exploration& exploration = context.exploration();
  if (!exploration.is_on()) {
    tell_unmatched(use, context);
    return;
  }
  if (use.performed.find(kUnknownOutput) != std::string::npos) {
    return;
  }
  const ParameterSections read = [&] {
    try {
      return read_parameter_sections(text_of(use));
    } catch (const LaunchError& error) {
      exploration.remark(error.diagnostics().front());
      return ParameterSections();
    }
  }();
  if (is_new(use, exploration)) {
    for (const std::optional<Diagnostic>& fault : {read.no_yaml, read.node_refuses}) {
      if (fault) {
        exploration.remark(*fault);
      }
    }
    for (const ParameterSection& section : read.sections) {
      for (const std::vector<Diagnostic>& errors : {section.errors, section.node_errors}) {
        std::for_each(errors.begin(), errors.end(), [&](const Diagnostic& error) { exploration.remark(error); });
      }
    }
    find_repeated(read, exploration);
  }
  if (!read.no_yaml && !read.node_refuses) {
    find_unmatched(read, use, exploration);
    find_empty_lists(read, use, exploration);
  }
}

void find_faults_of_named_files(const std::vector<std::string>& argv, std::size_t first, std::size_t last,
                                const SourceRange& where, LaunchContext& context) {
  if (context.scope().machine != nullptr) {
    return;  // they are there
  }
  for (std::size_t i = std::max<std::size_t>(first, 1); i < last; ++i) {
    std::error_code ignored;
    if (argv[i - 1] == "--params-file" && std::filesystem::is_regular_file(argv[i], ignored)) {
      find_faults_of_parameter_file({argv[i], where, known_node_name(argv)}, context);
    }
  }
}

}  // namespace launch
