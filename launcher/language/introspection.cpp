// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/introspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

namespace launch {

namespace {

// A longer chain of includes than this includes itself.
constexpr int kMaximumDepth = 64;

// Walks the actions of a description and of the files that it includes. Calls `seen` for each declaration, with the
// names that the includes on the way to it give.
class Walk {
 public:
  using Seen = std::function<void(const ArgumentDeclaration&, bool conditional, const std::set<std::string>& given)>;

  Walk(const Registry& registry, Scope scope, bool follow_dirname, Seen seen)
      : registry_(registry), scope_(std::move(scope)), follow_dirname_(follow_dirname), seen_(std::move(seen)) {}

  void description(const LaunchDescription& description, const std::set<std::string>& given, bool conditional,
                   int depth) {
    const std::shared_ptr<const SourceFile> outer = scope_.current_file;
    scope_.current_file = follow_dirname_ ? description.file : nullptr;
    actions(description.actions, given, conditional, depth);
    scope_.current_file = outer;
  }

  std::vector<std::shared_ptr<const LaunchDescription>> take_loaded() { return std::move(loaded_); }
  bool complete() const { return complete_; }

 private:
  void actions(const std::vector<ActionPtr>& actions_to_walk, const std::set<std::string>& given, bool conditional,
               int depth) {
    for (const ActionPtr& action : actions_to_walk) {
      const Introspection known = action->introspect();
      const bool maybe = conditional || action->condition().is_given();
      if (known.argument != nullptr) {
        seen_(*known.argument, maybe, given);
      }
      if (known.children != nullptr) {
        actions(*known.children, given, maybe || known.children_may_not_run, depth);
      }
      if (known.description != nullptr) {
        loaded_.push_back(*known.description);
        description(**known.description, given, maybe, depth);
      }
      if (known.include != nullptr && depth < kMaximumDepth) {
        include(*known.include, given, maybe, depth);
      }
    }
  }

  void include(const IncludeDeclaration& declaration, std::set<std::string> given, bool conditional, int depth) {
    std::shared_ptr<const LaunchDescription> included;
    try {
      included = load_launch_description(declaration.file.perform(scope_), registry_, scope_, declaration.file.where());
      for (const auto& [name, value] : declaration.arguments) {
        given.insert(name.perform(scope_));
      }
    } catch (const LaunchError&) {
      complete_ = false;
      return;  // it is not known before the visit, which reports the error
    }
    loaded_.push_back(included);
    description(*included, given, conditional, depth + 1);
  }

  const Registry& registry_;
  Scope scope_;
  bool follow_dirname_;
  Seen seen_;
  std::vector<std::shared_ptr<const LaunchDescription>> loaded_;
  bool complete_ = true;
};

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  }
  return "[" + text + "]";
}

}  // namespace

ArgumentList find_arguments(const LaunchDescription& description, const Registry& registry, Scope scope) {
  ArgumentList list;
  std::set<std::string> names;
  Walk walk(registry, std::move(scope), true,
            [&](const ArgumentDeclaration& declaration, bool conditional, const std::set<std::string>&) {
              if (names.insert(declaration.name).second) {
                list.arguments.push_back({&declaration, conditional});
              }
            });
  walk.description(description, {}, false, 0);
  list.loaded = walk.take_loaded();
  list.complete = walk.complete();
  return list;
}

void check_required_arguments(const LaunchDescription& description, const Registry& registry, Scope scope,
                              const std::vector<std::string>& given, const SourceRange& where) {
  std::optional<LaunchError> missing;
  Walk walk(registry, std::move(scope), false,
            [&](const ArgumentDeclaration& declaration, bool conditional, const std::set<std::string>& names) {
              if (missing || conditional || declaration.default_value || names.contains(declaration.name)) {
                return;
              }
              const std::vector<std::string> listed(names.begin(), names.end());
              missing.emplace(
                  fmt::format("included launch description missing required argument '{}' (description: '{}'), "
                              "given: {}",
                              declaration.name, declaration.description, quoted_list(listed)),
                  where,
                  fmt::format("it is declared without a default at {}; add an arg of that name to the include",
                              to_string(declaration.where)),
                  Finding::kArgument);
            });
  walk.description(description, std::set<std::string>(given.begin(), given.end()), false, 0);
  if (missing) {
    throw LaunchError(*missing);
  }
}

std::string show_arguments(const ArgumentList& list) {
  if (list.arguments.empty()) {
    return "No arguments.\n";
  }
  std::string text = "Arguments (pass arguments as '<name>:=<value>'):\n";
  bool any_conditional = false;
  for (const ArgumentInfo& info : list.arguments) {
    const ArgumentDeclaration& argument = *info.declaration;
    any_conditional |= info.conditional;
    text += fmt::format("\n    '{}':{}\n", argument.name, info.conditional ? "*" : "");
    std::string description = argument.description;
    if (!argument.choices.empty()) {
      description = description.empty()
                        ? fmt::format("One of: {}", quoted_list(argument.choices))
                        : fmt::format("{}. Valid choices are: {}", description, quoted_list(argument.choices));
    }
    text += fmt::format("        {}\n", description.empty() ? "no description given" : description);
    if (argument.default_value) {
      text += fmt::format("        (default: {})\n", argument.default_value->describe());
    }
  }
  if (any_conditional) {
    text += "\n* argument(s) which are only used if specific conditions occur\n";
  }
  return text;
}

}  // namespace launch
