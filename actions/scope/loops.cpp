// SPDX-License-Identifier: Apache-2.0
// <for len="…" name="…"> and <for_each values="…">: visit actions several times.
#include <fmt/format.h>

#include <charconv>

#include "base/text/ascii.hpp"
#include "launcher/frontend/yaml_document.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/visit/launch_context.hpp"

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

class ForLoop : public Action {
 public:
  explicit ForLoop(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        length_(fields.text("len")),
        name_(fields.literal("name")),
        actions_(fields.actions()) {}

  Introspection introspect() const override { return {.children = &actions_, .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    const std::string text = length_.perform(context.scope());
    const std::string_view digits = trim(text);
    std::int64_t length = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) {
      throw LaunchError(fmt::format("the length of a loop is a whole number, got '{}'", text), length_.where(),
                        "0 or more; $(index NAME) counts from 0");
    }
    if (length > kMostTurns) {
      throw LaunchError(fmt::format("the loop has {} turns, more than {}", length, kMostTurns), length_.where(),
                        fmt::format("0 to {}; $(index NAME) counts from 0", kMostTurns));
    }
    if (length <= 0 && context.scope().warn) {
      context.scope().warn(length_.where(), fmt::format("the loop has no turns: its length is {}", length));
    }
    for (std::int64_t i = 0; i < length; ++i) {
      visit_turn(context, {{name_, fmt::format("{}", i)}}, actions_);
    }
  }

 private:
  Template length_;
  std::string name_;
  std::vector<ActionPtr> actions_;
};

class ForEach : public Action {
 public:
  explicit ForEach(const Fields& fields)
      : Action(fields.where(), fields.condition()), values_(fields.text("values")), actions_(fields.actions()) {}

  Introspection introspect() const override { return {.children = &actions_, .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    const std::vector<LoopVariables> turns = read_turns(values_.perform(context.scope()));
    if (turns.empty() && context.scope().warn) {
      context.scope().warn(values_.where(), "the loop has no turns: there are no values");
    }
    for (const LoopVariables& turn : turns) {
      visit_turn(context, turn, actions_);
    }
  }

 private:
  std::vector<LoopVariables> read_turns(std::string_view text) const {
    std::vector<LoopVariables> turns;
    for (text = trim(text); !text.empty();) {
      const std::size_t end = std::min(text.find(kSeparator), text.size());
      const std::string item(trim(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!item.empty()) {
        turns.push_back(read_turn(item));
      }
    }
    return turns;
  }

  LoopVariables read_turn(const std::string& text) const {
    YamlNode node;
    try {
      std::vector<Diagnostic> duplicate_keys;  // the last one counts
      node = read_yaml(LocatedText(text), duplicate_keys);
    } catch (const LaunchError& error) {
      throw LaunchError(
          fmt::format("the values of a turn are no YAML: {}: '{}'", error.diagnostics().front().message, text),
          values_.where());
    }
    if (node.kind != YamlNode::Kind::kMapping) {
      throw LaunchError(fmt::format("the values of a turn are a mapping, got '{}'", text), values_.where(),
                        "write {name: a, id: 1};{name: b, id: 2}");
    }
    LoopVariables variables;
    for (const YamlEntry& entry : node.entries) {
      variables.insert_or_assign(entry.key.scalar.text.text(), python_text(entry.value));
    }
    return variables;
  }

  // A value as Python's str() gives it, because $(for-var x) shows this text.
  std::string python_text(const YamlNode& node) const {
    if (node.is_null()) {
      return "None";
    }
    if (node.kind == YamlNode::Kind::kSequence) {
      std::string text;
      for (const YamlNode& item : node.items) {
        const bool is_text = item.kind == YamlNode::Kind::kScalar && item.scalar.type == Scalar::Type::kString;
        text += text.empty() ? "" : ", ";
        text += is_text ? "'" + item.scalar.text.text() + "'" : python_text(item);
      }
      return "[" + text + "]";
    }
    if (node.kind == YamlNode::Kind::kMapping) {
      throw LaunchError("a loop variable can't be a mapping", values_.where(), "use a key of its own for each value");
    }
    return to_python_text(parameter_of({node.scalar, values_.where()}));
  }

  Template values_;
  std::vector<ActionPtr> actions_;
};

}  // namespace

ActionType for_action() {
  return {
      .tag = "for",
      .help = "Visits its actions a number of times; $(index NAME) counts from 0.",
      .attributes = {{"len", AttributeType::kText, true, "", "how many times"},
                     {"name", AttributeType::kLiteral, true, "", "name of the index"}},
      .items = {},
      .holds_actions = true,
      .make = [](const Fields& fields) { return std::make_shared<ForLoop>(fields); },
  };
}

ActionType for_each_action() {
  return {
      .tag = "for_each",
      .help = "Visits its actions once for each set of values; $(for-var KEY) gives a value.",
      .attributes = {{"values", AttributeType::kText, true, "", "YAML mappings, separated by semicolons"}},
      .items = {},
      .holds_actions = true,
      .make = [](const Fields& fields) { return std::make_shared<ForEach>(fields); },
  };
}

}  // namespace launch
