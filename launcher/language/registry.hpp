// SPDX-License-Identifier: Apache-2.0
// The language of launch files: a declaration for each action, and a loader for each kind of launch file that is a
// program.
//
// The declaration of an action is its tag, its attributes and items with their types, a line of help, and how to make
// it. Parsing, the errors for unknown or missing attributes, and the reference page all come from the declaration.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/language/action.hpp"
#include "launcher/substitution/foreign_substitutions.hpp"

namespace launch {

struct Entity;
class Fields;
class Registry;
struct LaunchDescription;
struct Scope;

enum class AttributeType {
  kText,         // text with substitutions, performed when the action is visited
  kLiteral,      // text as it stands; `\x` gives x
  kBoolean,      // true or false (YAML 1.1 words, 1, 0), or substitutions that give a boolean
  kFloat,        // a number, or substitutions that give a number
  kInteger,      // a whole number, or substitutions that give a whole number
  kCommandLine,  // split into words as a POSIX shell does, then performed
  kWords,        // the same; in YAML also a list of texts, each of them a word
  kParameter,    // any scalar or list: the value of a parameter
};

struct AttributeSpec {
  std::string name;
  AttributeType type = AttributeType::kText;
  bool required = false;
  std::string default_value;  // as the reference page shows it
  std::string help;
  bool extension = false;  // `ros2 launch` does not know it (docs/extensions.md)
};

// A structured item of an action: <param>, <remap>, <choice> …
struct ItemSpec {
  std::string tag;
  std::string help;
  std::vector<AttributeSpec> attributes;
  bool recursive = false;       // may hold items of its own tag
  std::vector<ItemSpec> items;  // other items that it may hold
  bool has_condition = false;   // takes `if` and `unless`
  bool extension = false;       // as for an attribute
};

struct ActionType {
  std::string tag;
  std::string help;
  std::vector<AttributeSpec> attributes;  // without `if` and `unless`, which every action has
  std::vector<ItemSpec> items;
  bool holds_actions = false;
  bool may_hold_none = false;  // in YAML, `children` may be left out
  bool extension = false;      // as for an attribute
  // Makes the action from fields that agree with this declaration. May throw LaunchError for rules that the declaration
  // doesn't hold.
  std::function<ActionPtr(Fields)> make;
};

// Makes the actions of a launch file that is a program. `scope` is the scope of the visit. Throws LaunchError.
using LaunchFileLoader = std::function<std::shared_ptr<const LaunchDescription>(
    std::shared_ptr<const SourceFile> file, const Registry& registry, const Scope& scope)>;

// Actions that no declaration makes: those of Python packages.
struct ForeignActions {
  // The action of an element; null when nothing knows its tag. Throws LaunchError.
  std::function<ActionPtr(const Entity&, const Registry&)> make;
  // The tags, and why some may be missing (empty: none is).
  std::function<ForeignNames()> names;
};

class Registry {
 public:
  // Throws std::logic_error when the tag is taken.
  void add(ActionType type);
  const ActionType* find(std::string_view tag) const;
  const std::map<std::string, ActionType, std::less<>>& types() const { return types_; }

  // Launch files whose path has this ending are loaded by `loader`, and not read as XML or YAML.
  void add_loader(std::string ending, LaunchFileLoader loader);
  const LaunchFileLoader* find_loader(std::string_view path) const;

  // Makes the actions whose tags have no declaration. At most one can be there.
  void use_foreign_actions(ForeignActions actions) { foreign_actions_ = std::move(actions); }
  // Without functions when there are none.
  const ForeignActions& foreign_actions() const { return foreign_actions_; }

 private:
  ForeignActions foreign_actions_;
  std::map<std::string, ActionType, std::less<>> types_;
  std::map<std::string, LaunchFileLoader> loaders_;  // by the ending of a path
};

}  // namespace launch
