// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/python_expressions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/text/quoted_text.hpp"
#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/formatted.hpp"

namespace launch {

std::string python_literal(std::string_view text) {
  return backslash_quoted(text, '\'');
}

const std::string& text_of(const Value& value) {
  return value.scalar()->text.text();
}

std::string PythonCall::text(std::size_t indent) const {
  const std::string line = fmt::format("{}{}{}", head, fmt::join(arguments, ", "), tail);
  if (line.find('\n') == std::string::npos && indent + line.size() < kFormattedColumns) {
    return line;
  }
  std::string result = head + "\n";
  for (const std::string& argument : arguments) {
    result += fmt::format("{:{}}{},\n", "", indent + 4, argument);
  }
  return result + fmt::format("{:{}}{}", "", indent, tail);
}

void PythonExpressions::refuse(const std::string& what, const SourceRange& where) {
  errors_.push_back({Severity::kError, fmt::format("launch convert knows no form in Python for {}", what), where,
                     "write it by hand (docs/python_launch_files.md), or leave this file as it is and include it"});
}

std::string PythonExpressions::name(std::string_view module, std::string_view name) {
  imports_[std::string(module)].insert(std::string(name));
  return std::string(name);
}

std::string PythonExpressions::text(const std::vector<SubstitutionText>& pieces, const SourceRange& where) {
  std::vector<std::string> parts;
  for (const SubstitutionText& piece : pieces) {
    parts.push_back(piece.call.empty() ? python_literal(piece.words) : call(piece.call.front(), where));
  }
  return parts.empty() ? "''" : parts.size() == 1 ? parts.front() : fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string PythonExpressions::text(const std::string& given, const SourceRange& where) {
  return text(substitution_texts(given), where);
}

std::string PythonExpressions::call(const SubstitutionCall& call, const SourceRange& where) {
  const auto found = python_substitutions().find(call.name);
  if (found == python_substitutions().end() || call.arguments.size() > found->second.arguments.size()) {
    refuse(fmt::format("this use of $({})", call.name), where);
    return "None";
  }
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const std::string_view argument = found->second.arguments[i];
    arguments.push_back((argument.empty() ? "" : std::string(argument) + "=") + text(call.arguments[i], where));
  }
  return fmt::format("{}({})", name(found->second.module, found->second.name), fmt::join(arguments, ", "));
}

std::string PythonExpressions::typed(const Value& value) {
  if (const auto* const list = value.list()) {
    std::vector<std::string> items;
    std::transform(list->begin(), list->end(), std::back_inserter(items),
                   [this](const Value& item) { return typed(item); });
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  const Scalar& scalar = *value.scalar();
  switch (scalar.type) {
    case Scalar::Type::kBool:
      return scalar.bool_value ? "True" : "False";
    case Scalar::Type::kInt:
      return std::to_string(scalar.int_value);
    case Scalar::Type::kFloat: {
      const std::string number = fmt::format("{}", scalar.float_value);
      return number.find_first_of("n") != std::string::npos ? fmt::format("float('{}')", number) : number;
    }
    case Scalar::Type::kUntyped:
      return typed_text(scalar.text.text(), value.where);
    default:
      return text(scalar.text.text(), value.where);
  }
}

std::string PythonExpressions::typed_text(const std::string& given, const SourceRange& where) {
  if (given.find("$(") != std::string::npos) {
    return text(given, where);
  }
  try {
    const Value read = yaml11_value(LocatedText(given));
    return read.scalar() != nullptr && read.scalar()->type == Scalar::Type::kUntyped ? text(given, where) : typed(read);
  } catch (const LaunchError&) {
    return text(given, where);
  }
}

std::string PythonExpressions::argument(const PythonArgument& argument, const Value& value) {
  if (argument.kind == PythonKind::kTyped) {
    return typed(value);
  }
  if (argument.kind == PythonKind::kWords) {
    return words(value);
  }
  if (value.scalar() == nullptr) {
    refuse("a list here", value.where);
    return "None";
  }
  const std::string& given = text_of(value);
  const Scalar read = yaml11_scalar(LocatedText(given));
  switch (argument.kind) {
    case PythonKind::kLiteral:
      return python_literal(given);
    case PythonKind::kBool:
      return read.type == Scalar::Type::kBool ? (read.bool_value ? "True" : "False") : text(given, value.where);
    case PythonKind::kNumber:
      return read.type == Scalar::Type::kInt     ? std::to_string(read.int_value)
             : read.type == Scalar::Type::kFloat ? given
                                                 : text(given, value.where);
    default:
      return text(given, value.where);
  }
}

std::string PythonExpressions::words(const Value& value) {
  PythonCall list{"[", {}, "]"};
  if (const auto* const items = value.list()) {
    for (const Value& item : *items) {
      list.arguments.push_back(text(text_of(item), item.where));
    }
  } else {
    for (const std::vector<SubstitutionText>& word : command_words(text_of(value))) {
      list.arguments.push_back(text(word, value.where));
    }
  }
  return list.text(kFormattedColumns / 4);
}

}  // namespace launch
