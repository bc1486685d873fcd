// SPDX-License-Identifier: Apache-2.0
#include "actions/values/quirks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <map>
#include <optional>
#include <string_view>

#include "base/text/ascii.hpp"
#include "base/text/names.hpp"
#include "launcher/substitution/unrun_commands.hpp"

namespace launch {

namespace {

bool is_variable(const Substitution& part) {
  const std::string text = part.describe();
  return text.starts_with("LaunchConfig(") || text.starts_with("EnvVar(");
}

// Whether a word behind the first one is an option or a remap, as in "-x 0.5 -y 1" or "a:=b c:=d".
bool has_options(std::string_view text) {
  for (std::size_t blank = text.find(' '); blank != std::string_view::npos; blank = text.find(' ', blank + 1)) {
    const std::string_view word = text.substr(blank + 1, text.find(' ', blank + 1) - blank - 1);
    const bool is_option =
        word.size() > 1 && word[0] == '-' && (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
    if (is_option || word.find(":=") != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

template <typename Map>
std::vector<std::string> changed(const Map& before, const Map& after) {
  std::vector<std::string> names;
  for (const auto& [name, value] : after) {
    const auto old = before.find(name);
    if (old == before.end() || old->second != value) {
      names.push_back(name);
    }
  }
  for (const auto& [name, value] : before) {
    if (!after.contains(name)) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace

void find_variables_with_blanks(const std::vector<Template>& words, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  for (const Template& word : words) {
    const std::vector<SubstitutionPtr> parts = word.parts();
    for (const SubstitutionPtr& part : parts) {
      if (!is_variable(*part)) {
        continue;
      }
      const std::string performed = part->perform(context.scope());
      const std::string_view value = trim(performed);
      // A document, such as the description of a robot, is one word.
      const bool is_text = value.find_first_of("\n<{") != std::string_view::npos;
      if (is_text || value.find(kUnknownOutput) != std::string_view::npos ||
          value.find(' ') == std::string_view::npos || (parts.size() > 1 && !has_options(" " + std::string(value)))) {
        continue;
      }
      context.exploration().remark({Severity::kWarning, fmt::format("'{}' is one word of the command line", value),
                                    part->where(),
                                    "it is split before variables are replaced: write the words here, each with a "
                                    "variable of its own",
                                    Finding::kOneWord});
    }
  }
}

void find_lost_backslash(const std::shared_ptr<const SourceFile>& file, LaunchContext& context) {
  const std::string_view text = file->text();
  int depth = 0;  // of substitutions, which need backslashes
  std::size_t first = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '#' && depth == 0 &&
        (i == 0 || std::string_view(" \t\n").find(text[i - 1]) != std::string_view::npos)) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text[i] == '$' && text[i + 1] == '(') {
      ++depth;
      ++i;
    } else if (depth > 0 && (text[i] == '(' || text[i] == ')')) {
      depth += text[i] == '(' ? 1 : -1;
    } else if (text[i] == '\\') {
      if (depth == 0 && text[i + 1] != '\\' && text[i + 1] != '$' && text[i + 1] != '\n') {
        first = count++ == 0 ? i : first;
      }
      ++i;
    }
  }
  if (count > 0) {  // one warning for a file
    context.exploration().remark({Severity::kWarning,
                                  fmt::format("the backslash of '{}' goes", text.substr(first, 2)) +
                                      (count > 1 ? fmt::format(", and {} more of this file", count - 1) : ""),
                                  {file, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first + 2)},
                                  "performing the substitutions of a file takes backslashes away: write two for one",
                                  Finding::kLostBackslash});
  }
}

void find_useless_separator(const std::string& text, const std::string& separator, const SourceRange& where,
                            LaunchContext& context) {
  if (text.find(separator) != std::string::npos) {
    return;
  }
  // A list of one item is not suspicious, if it is one.
  const bool has_substitution = text.find("$(") != std::string::npos;
  if (has_substitution || trim(text).find_first_of(",;|") != std::string_view::npos) {
    context.exploration().remark({Severity::kWarning, fmt::format("value-sep '{}' splits nothing", separator), where,
                                  has_substitution ? "a text is split before its variables are replaced: write a list, "
                                                     "[$(var a), $(var b)]"
                                                   : "the text does not hold it",
                                  Finding::kUselessSeparator});
  }
}

void find_leak(const Scope& before, const SourceRange& include, LaunchContext& context) {
  const Scope& after = context.scope();
  std::vector<std::string> left;
  const auto add = [&](std::string_view what, const std::vector<std::string>& names) {
    if (!names.empty()) {
      left.push_back(fmt::format("{} {}", what, list_some(names)));
    }
  };
  std::vector<std::string> configurations = changed(before.configurations, after.configurations);
  std::erase(configurations, "ros_namespace");
  add("configurations", configurations);
  add("environment", changed(before.environment, after.environment));
  const auto pushed = after.configurations.find("ros_namespace");
  const auto old = before.configurations.find("ros_namespace");
  if (pushed != after.configurations.end() && (old == before.configurations.end() || old->second != pushed->second)) {
    left.push_back("namespace " + pushed->second);
  }
  if (after.global_parameters.size() != before.global_parameters.size()) {
    left.emplace_back("parameters");
  }
  if (after.global_remaps.size() != before.global_remaps.size()) {
    left.emplace_back("remaps");
  }
  if (!left.empty()) {
    context.exploration().remark(
        {Severity::kWarning, fmt::format("the included file leaves behind: {}", fmt::join(left, "; ")), include,
         "to keep it inside, write scoped=\"true\", or a group around the include", Finding::kLeak});
  }
}

}  // namespace launch
