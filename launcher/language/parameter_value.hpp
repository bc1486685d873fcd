// SPDX-License-Identifier: Apache-2.0
// The typed value of a parameter. It is read at load, finished at visit when it holds substitutions, and written as
// YAML.
//
// The pipeline is ros2 launch's: XML text is typed by YAML 1.1 rules at load (YAML files come typed), substitutions in
// the resulting strings are performed at visit, and their result is typed again. So value="'$(var x)'" gives an int for
// x=7: the quotes are gone before the substitution is performed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "launcher/frontend/entity.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/substitution/substitution.hpp"

namespace launch {

// The types that a `type` attribute names.
enum class ParameterType { kAny, kStr, kBool, kInt, kFloat };

class ParameterValueSource {
 public:
  // `type` is the text of the type attribute, "" for none; `separator` is the text of value-sep. Throws LaunchError.
  ParameterValueSource(const Value& value, const std::string& type, const std::optional<std::string>& separator,
                       const SourceRange& type_where);

  // Throws LaunchError when the result of a substitution does not fit the type.
  ParameterValue perform(Scope& scope) const;

 private:
  // A finished scalar, or text that must be performed and typed.
  using Item = std::variant<ParameterScalar, Template>;

  Item make_item(const Scalar& scalar) const;
  Item make_untyped(const LocatedText& text) const;
  void take_value(const Value& value);
  void take_items(const std::vector<Value>& values);
  ParameterValue type_text(const std::string& text, const SourceRange& where) const;
  ParameterValue typed_list(const std::string& text, const SourceRange& where) const;

  ParameterType type_ = ParameterType::kAny;
  bool type_is_list_ = false;
  SourceRange where_;
  bool is_list_ = false;
  std::vector<Item> items_;  // one, unless is_list_
};

// Types performed text by YAML 1.1 rules; empty text is an empty string. Throws LaunchError at `where` for a text that
// can't be a parameter: nothing, a mapping, a list of several types.
ParameterValue typed_parameter(const std::string& text, const SourceRange& where);
// Turns a typed value into a parameter. Throws LaunchError, as typed_parameter() does.
ParameterValue parameter_of(const Value& value);

// One line of YAML to which any reader of parameter files gives the same type: strings are always quoted.
std::string to_yaml(const ParameterValue& value);
// The text behind "-p NAME:=". It is as ros2 launch writes it, except that strings that a node would read as another
// type are quoted, and lists are YAML.
std::string to_argument(const ParameterValue& value);
// A mapping key, quoted unless it is plain letters, digits, '_', '.', '-' and '/'.
std::string quote_yaml_if_needed(const std::string& key);

}  // namespace launch
