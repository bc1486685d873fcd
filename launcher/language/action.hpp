// SPDX-License-Identifier: Apache-2.0
// One thing that a launch file asks for.
//
// An action is made once, while its file is loaded, and never changes. LaunchContext::visit()
// (launcher/visit/launch_context.hpp) visits it: the context asks the condition, and then lets the action change the
// context. Derived classes implement execute() and, when they hold other actions, introspect().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/substitution/substitution.hpp"

namespace launch {

class Action;
class LaunchContext;
struct LaunchDescription;

using ActionPtr = std::shared_ptr<const Action>;

// A launch argument, from the declaration of its `arg`.
struct ArgumentDeclaration {
  std::string name;
  std::optional<Template> default_value;
  std::string description;
  std::vector<std::string> choices;
  SourceRange where;
};

// The target of an `include`, before anything is performed.
struct IncludeDeclaration {
  Template file;
  std::vector<std::pair<Template, Template>> arguments;  // name, value
  SourceRange where;
};

// The facts about an action that are known without running it (for `--show-args` and the check for required arguments).
struct Introspection {
  const ArgumentDeclaration* argument = nullptr;
  const IncludeDeclaration* include = nullptr;
  const std::shared_ptr<const LaunchDescription>* description = nullptr;  // a launch file that is already loaded
  const std::vector<ActionPtr>* children = nullptr;
  bool children_may_not_run = false;  // they wait for something, like the children of a timer
};

// Its `if` and `unless`.
class Condition {
 public:
  Condition() = default;  // always holds
  Condition(Template expression, bool negated) : expression_(std::move(expression)), negated_(negated) {}

  bool is_given() const { return expression_.has_value(); }

  // Throws LaunchError when the performed text is not true, 1, false or 0 (in any case).
  bool holds(Scope& scope) const;

 private:
  std::optional<Template> expression_;
  bool negated_ = false;
};

class Action {
 public:
  Action(SourceRange where, Condition condition) : where_(std::move(where)), condition_(std::move(condition)) {}
  virtual ~Action() = default;
  Action(const Action&) = delete;
  Action& operator=(const Action&) = delete;

  // Does the work of the action, whatever its condition says. Called by the context. Throws LaunchError.
  virtual void execute(LaunchContext& context) const = 0;

  virtual Introspection introspect() const { return {}; }

  const SourceRange& where() const { return where_; }
  const Condition& condition() const { return condition_; }

 private:
  SourceRange where_;
  Condition condition_;
};

}  // namespace launch
