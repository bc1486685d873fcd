// SPDX-License-Identifier: Apache-2.0
// The template grammar: text with $(name arg …) inside, escapes and quoting.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/substitution/substitution.hpp"

namespace launch {

// One declaration per substitution: how it is called, how many arguments it takes, what it does.
struct SubstitutionType {
  static constexpr int kAnyNumber = -1;

  std::string name;  // "find-pkg-share"
  int minimum_arguments = 0;
  int maximum_arguments = 0;  // kAnyNumber: no upper bound
  std::string usage;          // "$(find-pkg-share PKG)"
  std::string help;           // one line for the reference page
  std::function<SubstitutionPtr(std::vector<Template> arguments, SourceRange where)> make;
};

// The error for this number of arguments; nullopt when the substitution takes it.
std::optional<std::string> wrong_number_of_arguments(const SubstitutionType& type, std::size_t count);

// Every substitution there is, by name. The built-in ones are listed in builtin_substitutions.cpp.
const std::vector<SubstitutionType>& substitution_types();

// Parses a template. Throws LaunchError pointing at the offending place for a syntax error, an unknown name (with a
// suggestion) or a wrong number of arguments.
Template parse_template(const LocatedText& text);

// Removes backslash escapes as literal attributes do (`\c` becomes `c`), without looking for substitutions.
std::string unescape(std::string_view text);

// Splits a parsed command line into words. Literal text is split as POSIX shell words. The result of a substitution is
// never split and joins the text beside it. Throws LaunchError ("no closing quotation").
std::vector<Template> split_command_line(const Template& command_line);

// Splits performed text as POSIX shell words (launch-prefix, $(command)). Throws LaunchError pointing at `where`.
std::vector<std::string> split_shell_words(std::string_view text, const SourceRange& where);

}  // namespace launch
