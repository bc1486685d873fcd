// SPDX-License-Identifier: Apache-2.0
// The elements of XML and YAML launch files that have a form in Python: classes and their arguments.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

enum class PythonKind {
  kText,     // substitutions
  kLiteral,  // a text without substitutions
  kWords,    // a command line: a list of words
  kBool,
  kNumber,
  kTyped,  // what the rules of YAML make of it
};

struct PythonArgument {
  std::string_view attribute;
  std::string_view name;
  PythonKind kind = PythonKind::kText;
};

struct PythonForm {
  std::string_view module;  // "launch.actions"
  std::string_view name;    // "Node"
  std::vector<PythonArgument> arguments;
};

// By the tag.
const std::map<std::string_view, PythonForm>& python_forms();

// What makes an object of a substitution, by its name: the class, and the arguments in order. An argument without a
// name is positional.
struct PythonSubstitution {
  std::string_view module;
  std::string_view name;
  std::vector<std::string_view> arguments;
};

const std::map<std::string_view, PythonSubstitution>& python_substitutions();

}  // namespace launch
