// SPDX-License-Identifier: Apache-2.0
// Values of launch files as expressions of Python.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/entity.hpp"
#include "programs/launch/rewrite/python_forms.hpp"
#include "programs/launch/rewrite/substitution_text.hpp"

namespace launch {

std::string python_literal(std::string_view text);

// Of a value that is one text.
const std::string& text_of(const Value& value);

// An object as a call: one line if that is short, or a line for each argument.
struct PythonCall {
  std::string head;  // "Node("
  std::vector<std::string> arguments;
  std::string tail = ")";

  std::string text(std::size_t indent) const;
};

// Writes expressions, and knows then what must be imported and what has no form in Python.
class PythonExpressions {
 public:
  // Notes that there is no form for this.
  void refuse(const std::string& what, const SourceRange& where);
  // Notes the import, and returns the name.
  std::string name(std::string_view module, std::string_view name);
  // One expression, or a list of them.
  std::string text(const std::string& given, const SourceRange& where);
  // What the rules of YAML make of the text of a parameter.
  std::string typed(const Value& value);
  std::string argument(const PythonArgument& argument, const Value& value);

  const std::map<std::string, std::set<std::string>>& imports() const { return imports_; }  // names by module
  const std::vector<Diagnostic>& errors() const { return errors_; }

 private:
  std::string text(const std::vector<SubstitutionText>& pieces, const SourceRange& where);
  std::string call(const SubstitutionCall& call, const SourceRange& where);
  std::string typed_text(const std::string& given, const SourceRange& where);
  std::string words(const Value& value);

  std::map<std::string, std::set<std::string>> imports_;
  std::vector<Diagnostic> errors_;
};

}  // namespace launch
