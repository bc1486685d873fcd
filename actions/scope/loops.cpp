// SPDX-License-Identifier: Apache-2.0
// <for len="…" name="…"> and <for_each values="…">: visit actions several times.
#include <fmt/format.h>

#include <charconv>

#include "actions/row_action.hpp"
#include "base/text/ascii.hpp"
#include "launcher/frontend/yaml_document.hpp"
#include "launcher/language/parameter_value.hpp"

namespace launch {

namespace {

constexpr char kSeparator = ';';
// More than any launch has: a mistyped length must not fill the memory.
constexpr std::int64_t kMostTurns = 100'000;

using LoopVariables = std::map<std::string, std::string>;

// Visits the actions of one turn. Only the variables of the loop end with the turn: a loop is no scope.
void visit_turn(LaunchContext& context, const LoopVariables& variables, const std::vector<ActionPtr>& actions) {
  LoopVariables outer = context.scope().loop_variables;
  for (const auto& [name, value] : variables) {
    context.scope().loop_variables.insert_or_assign(name, value);
  }
  context.visit(actions);
  context.scope().loop_variables = std::move(outer);
}

std::int64_t turns_of(const std::string& text, const SourceRange& where) {
  const std::string_view digits = trim(text);
  std::int64_t length = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) {
    throw LaunchError(fmt::format("the length of a loop is a whole number, got '{}'", text), where,
                      "0 or more; $(index NAME) counts from 0");
  }
  if (length > kMostTurns) {
    throw LaunchError(fmt::format("the loop has {} turns, more than {}", length, kMostTurns), where,
                      fmt::format("0 to {}; $(index NAME) counts from 0", kMostTurns));
  }
  return length;
}

void visit_times(const Fields& fields, LaunchContext& context, NoValues&) {
  const Template& given = fields.text("len");
  const std::int64_t length = turns_of(given.perform(context.scope()), given.where());
  if (length <= 0 && context.scope().warn) {
    context.scope().warn(given.where(), fmt::format("the loop has no turns: its length is {}", length));
  }
  for (std::int64_t i = 0; i < length; ++i) {
    visit_turn(context, {{fields.literal("name"), fmt::format("{}", i)}}, fields.actions());
  }
}

// A value as Python's str() gives it, because $(for-var x) shows this text.
std::string python_text(const YamlNode& node, const SourceRange& where) {
  if (node.is_null()) {
    return "None";
  }
  if (node.kind == YamlNode::Kind::kSequence) {
    std::string text;
    for (const YamlNode& item : node.items) {
      const bool is_text = item.kind == YamlNode::Kind::kScalar && item.scalar.type == Scalar::Type::kString;
      text += text.empty() ? "" : ", ";
      text += is_text ? "'" + item.scalar.text.text() + "'" : python_text(item, where);
    }
    return "[" + text + "]";
  }
  if (node.kind == YamlNode::Kind::kMapping) {
    throw LaunchError("a loop variable can't be a mapping", where, "use a key of its own for each value");
  }
  return to_python_text(parameter_of({node.scalar, where}));
}

LoopVariables read_turn(const std::string& text, const SourceRange& where) {
  YamlNode node;
  try {
    std::vector<Diagnostic> duplicate_keys;  // the last one counts
    node = read_yaml(LocatedText(text), duplicate_keys);
  } catch (const LaunchError& error) {
    throw LaunchError(
        fmt::format("the values of a turn are no YAML: {}: '{}'", error.diagnostics().front().message, text), where);
  }
  if (node.kind != YamlNode::Kind::kMapping) {
    throw LaunchError(fmt::format("the values of a turn are a mapping, got '{}'", text), where,
                      "write {name: a, id: 1};{name: b, id: 2}");
  }
  LoopVariables variables;
  for (const YamlEntry& entry : node.entries) {
    variables.insert_or_assign(entry.key.scalar.text.text(), python_text(entry.value, where));
  }
  return variables;
}

void visit_each(const Fields& fields, LaunchContext& context, NoValues&) {
  const Template& given = fields.text("values");
  const std::string performed = given.perform(context.scope());
  std::vector<LoopVariables> turns;
  for (std::string_view text = trim(performed); !text.empty();) {
    const std::size_t end = std::min(text.find(kSeparator), text.size());
    const std::string item(trim(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!item.empty()) {
      turns.push_back(read_turn(item, given.where()));
    }
  }
  if (turns.empty() && context.scope().warn) {
    context.scope().warn(given.where(), "the loop has no turns: there are no values");
  }
  for (const LoopVariables& turn : turns) {
    visit_turn(context, turn, fields.actions());
  }
}

}  // namespace

ActionType for_action() {
  return action_of<NoValues>({.tag = "for",
                              .help = "Visits its actions a number of times; $(index NAME) counts from 0.",
                              .attributes = {{"len", AttributeType::kText, true, "", "how many times"},
                                             {"name", AttributeType::kLiteral, true, "", "name of the index"}},
                              .holds_actions = true},
                             {}, visit_times);
}

ActionType for_each_action() {
  return action_of<NoValues>(
      {.tag = "for_each",
       .help = "Visits its actions once for each set of values; $(for-var KEY) gives a value.",
       .attributes = {{"values", AttributeType::kText, true, "", "YAML mappings, separated by semicolons"}},
       .holds_actions = true},
      {}, visit_each);
}

}  // namespace launch
