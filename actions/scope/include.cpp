// SPDX-License-Identifier: Apache-2.0
// <include file="…"/>: visits another launch file here, in the current scope.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "actions/process/machine_settings.hpp"
#include "actions/values/pair_items.hpp"
#include "actions/values/quirks.hpp"
#include "actions/values/ros_names.hpp"
#include "base/monotonic_clock.hpp"
#include "launcher/language/argument_use.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

// A longer chain of includes than this is taken for a file that includes itself without end.
constexpr int kMaximumDepth = 200;

int include_depth(const SourceRange& where) {
  int depth = 0;
  for (const SourceRange* place = &where; place->file != nullptr; place = &place->file->included_from()) {
    ++depth;
  }
  return depth;
}

// Whether one of several files may read an argument. Each file is searched once, when it is needed.
class Readers {
 public:
  void add(std::shared_ptr<const SourceFile> file) {
    if (file != nullptr) {
      files_.push_back(std::move(file));
    }
  }
  bool may_read(const std::string& name) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (i == uses_.size()) {
        uses_.emplace_back(files_[i]);
      }
      if (uses_[i].may_read(name)) {
        return true;
      }
    }
    return false;
  }

 private:
  std::vector<std::shared_ptr<const SourceFile>> files_;
  std::vector<ArgumentUse> uses_;  // of the first files
};

// What a launch file and those that it includes declare, and who may read what they do not.
struct DeclaredArguments {
  explicit DeclaredArguments(const ArgumentList& list) : complete(list.complete) {
    for (const ArgumentInfo& argument : list.arguments) {
      in_order.push_back(argument.declaration->name);
    }
    names.insert(in_order.begin(), in_order.end());
    for (const auto& description : list.loaded) {
      readers.add(description->file);
    }
  }

  bool complete;
  std::vector<std::string> in_order;
  std::set<std::string> names;
  Readers readers;
};

class IncludeLaunchDescription : public Action {
 public:
  explicit IncludeLaunchDescription(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        namespace_(fields.optional_text("ns")),
        machine_(fields.optional_text("machine")),
        scoped_(fields.boolean("scoped", false)) {
    declaration_.file = fields.text("file");
    declaration_.where = fields.where();
    // All `arg` come first, then all `let`, whatever their order in the file, as in ros2 launch.
    for (const char* const tag : {"arg", "let"}) {
      for (const Fields* item : fields.items(tag)) {
        declaration_.arguments.emplace_back(item->text("name"), item->text("value"));
      }
    }
  }

  Introspection introspect() const override { return {.include = &declaration_}; }

 protected:
  void execute(LaunchContext& context) const override {
    if (include_depth(where()) > kMaximumDepth) {
      throw LaunchError(fmt::format("includes are nested more than {} deep", kMaximumDepth), where(),
                        "a file includes itself, directly or through others", Finding::kEndless);
    }
    const std::shared_ptr<MachineView> machine =
        machine_ ? context.machines().find(machine_->perform(context.scope()), machine_->where())
                 : context.scope().machine;
    const std::string path = [&] {
      const AtMachine here(context, nullptr);  // launch files are read here
      return declaration_.file.perform(context.scope());
    }();
    std::error_code ignored;
    if (path.ends_with(".py") && context.is_plan_only() && !std::filesystem::exists(path, ignored)) {
      note_missing_python(path, context);
      return;
    }
    const std::int64_t begin = monotonic_time();
    const auto included = load_launch_description(path, context.registry(), context.scope(), declaration_.file.where());

    std::vector<std::string> given;
    for (const auto& [name, value] : declaration_.arguments) {
      given.push_back(name.perform(context.scope()));
    }
    check_required_arguments(*included, context.registry(), context.scope(), given, where());
    if (context.exploration().is_on()) {
      find_undeclared_arguments(*included, given, context);
      note_settings_file(*included, context);
    }
    ++context.requests().includes;
    // The arguments are performed inside, so that $(dirname) in a value means the included file, as in ros2 launch.
    const bool scoped = scoped_.perform(context.scope());
    std::optional<Scope> outer;
    if (scoped || context.exploration().finds_leaks()) {
      outer = context.scope();
    }
    const std::optional<std::string> outer_namespace = pushed_namespace(context.scope());
    if (namespace_) {
      push_namespace(*namespace_, context.scope());
    }
    const std::shared_ptr<MachineView> outer_machine = context.scope().machine;
    move_to_machine(context.scope(), machine, context.initial_environment());
    const bool only_planned =
        std::exchange(context.scope().only_planned, context.scope().only_planned && !context.scope().planned_by_timer);
    context.visit(*included, [&] { set_arguments(context.scope()); });
    context.scope().only_planned = only_planned;
    move_to_machine(context.scope(), outer_machine, context.initial_environment());
    if (namespace_) {
      restore_namespace(outer_namespace, context.scope());
    }
    if (scoped) {
      context.scope() = *std::move(outer);
    } else if (outer) {
      find_leak(*outer, where(), context);
    }
    context.requests().records.push_back({.kind = LaunchRecord::Kind::kInclude,
                                          .name = path,
                                          .where = where(),
                                          .time = begin,
                                          .duration = monotonic_time() - begin});
  }

 private:
  void set_arguments(Scope& scope) const {
    for (const auto& [name, value] : declaration_.arguments) {
      std::string key = name.perform(scope);
      scope.configurations.insert_or_assign(std::move(key), value.perform(scope));
    }
  }

  // The arguments that neither the included file nor a file around it declares or reads.
  void find_undeclared_arguments(const LaunchDescription& included, const std::vector<std::string>& given,
                                 LaunchContext& context) const {
    const bool depends_on_command = context.scope().command_was_left_out();
    Readers readers = files_that_may_read(included);
    std::optional<DeclaredArguments> declared;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (is_own_configuration(given[i]) || readers.may_read(given[i])) {
        continue;
      }
      if (!declared) {
        declared.emplace(find_arguments(included, context.registry(), context.scope()));
      }
      if (declared->complete && !declared->names.contains(given[i]) && !declared->readers.may_read(given[i])) {
        context.exploration().remark(
            {Severity::kWarning,
             fmt::format("the included file declares no argument '{}', and nothing reads it", given[i]),
             declaration_.arguments[i].first.where(), did_you_mean(given[i], declared->in_order),
             Finding::kUnknownArgument});
      }
    }
    if (!depends_on_command) {
      context.scope().forget_left_out_command();  // the paths of further includes were only tried
    }
  }

  // What an include sets stays set, so the files that lead to it may read it.
  Readers files_that_may_read(const LaunchDescription& included) const {
    Readers readers;
    readers.add(included.file);
    for (const SourceRange* place = &where(); place->file != nullptr; place = &place->file->included_from()) {
      readers.add(place->file);
    }
    return readers;
  }

  static void note_settings_file(const LaunchDescription& included, LaunchContext& context) {
    const bool only_declares =
        std::all_of(included.actions.begin(), included.actions.end(),
                    [](const ActionPtr& action) { return action->introspect().argument != nullptr; });
    if (only_declares && included.file != nullptr) {
      context.exploration().note_settings_file(included.file->path());
    }
  }

  // It is not known what a missing Python launch file would do, so a plan goes on without it.
  void note_missing_python(const std::string& path, LaunchContext& context) const {
    context.message(LogLevel::kWarning, "launch",
                    fmt::format("{}: what the Python launch file asks for is not known, it does not exist: {}",
                                to_string(declaration_.file.where()), path));
    context.requests().python_includes.push_back(std::filesystem::absolute(path).lexically_normal().string());
    set_arguments(context.scope());
  }

  IncludeDeclaration declaration_;
  std::optional<Template> namespace_;
  std::optional<Template> machine_;
  BooleanField scoped_;
};

}  // namespace

ActionType include_action() {
  return {
      .tag = "include",
      .help = "Visits another launch file in place. Not a scope unless it says so: what the file sets stays set.",
      .attributes = {{"file", AttributeType::kText, true, "",
                      "path of the launch file; relative to the launcher's working directory"},
                     {"ns", AttributeType::kText, false, "",
                      "namespace of every node of the file; ends with the file, unlike other settings", true},
                     machine_attribute("the machine of every process of the file; the file itself is read here"),
                     {"scoped", AttributeType::kBoolean, false, "false",
                      "true: what the file sets ends with it, as in a group", true}},
      .items = {pair_item("arg", "an argument for the file", "name of the configuration"),
                pair_item("let", "an argument for the file, set after all arg items", "name of the configuration")},
      .make = [](const Fields& fields) { return std::make_shared<IncludeLaunchDescription>(fields); },
  };
}

}  // namespace launch
