// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/check_launch_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>

#include "base/diagnostics/read_source_file.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/invocation/argument_check.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/language/argument_use.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/substitution/unrun_commands.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/launch/check/finders.hpp"
#include "programs/launch/check/ignored_findings.hpp"

namespace launch {

namespace {

class Checker {
 public:
  Checker(const Registry& registry, const Environment& environment, const CheckOptions& options)
      : registry_(registry), environment_(environment), options_(options) {}

  std::vector<Diagnostic> run(const std::string& path) {
    try {
      visit([&](const Scope& scope) { return load_launch_files({path}, registry_, scope); });
    } catch (const LaunchError& error) {
      add(error);
      check_what_can_not_be_read(path, error.diagnostics());
      check_what_does_not_load(path);
      check_without_unknown_attributes(error.diagnostics());
    }
    leave_out_ignored(readable(path), found_);
    return std::move(found_);
  }

 private:
  // `load` is given the scope of the visit.
  template <typename Load>
  void visit(Load load) {
    LaunchContext context(registry_, environment_, own_prefix(), [](auto, auto, auto) {});
    context.scope().log_directory = LogDirectory::choose(environment_);
    context.scope().warn = [this](const SourceRange& where, const std::string& text) {
      warn(Finding::kRemark, text, where);
    };
    context.scope().note_performed_file = [this](const auto& file) { performed_files_.push_back(file); };
    for (const auto& [name, value] : options_.arguments) {
      context.scope().configurations.insert_or_assign(name, value);
    }
    context.scope().unrun_commands = std::make_shared<UnrunCommands>();
    check(*load(context.scope()), context);
  }

  static std::shared_ptr<const SourceFile> readable(const std::string& path) {
    try {
      return read_source_file(path);
    } catch (const LaunchError&) {
      return nullptr;
    }
  }

  // In a file with syntax errors, the rest is looked at as far as it can be read.
  void check_what_can_not_be_read(const std::string& path, const std::vector<Diagnostic>& errors) {
    const Finding finding = errors.front().finding;
    const auto file =
        finding == Finding::kMalformedXml || finding == Finding::kMalformedYaml ? readable(path) : nullptr;
    if (file == nullptr || !errors.front().where || errors.front().where.file->path() != path) {
      return;
    }
    for (Diagnostic& diagnostic : find_in_broken_file(file, registry_, errors)) {
      add(std::move(diagnostic));
    }
  }

  // Extensions are found even in a file with other errors, unless the file can't be read at all.
  void check_what_does_not_load(const std::string& path) {
    if (!options_.strict_ros2) {
      return;
    }
    try {
      for (Diagnostic& diagnostic : beyond_ros2(read_source_file(path), registry_)) {
        add(std::move(diagnostic));
      }
    } catch (const LaunchError&) {
      // The error is reported already.
    }
  }

  void check_without_unknown_attributes(const std::vector<Diagnostic>& errors) {
    const std::string path = errors.front().where ? errors.front().where.file->path() : std::string();
    const auto file = registry_.find_loader(path) == nullptr ? readable(path) : nullptr;
    const auto description = file == nullptr ? nullptr : without_unknown_attributes(file, registry_, errors);
    if (description == nullptr) {
      return;
    }
    lacks_attributes_ = true;
    try {
      visit([&](const Scope&) { return description; });
    } catch (const LaunchError&) {
      // It may come from what is missing.
    }
  }

  void add(Diagnostic diagnostic) {
    if (lacks_attributes_ && diagnostic.finding != Finding::kUndefined && diagnostic.finding != Finding::kExpression &&
        diagnostic.finding != Finding::kMissingPackage) {
      return;
    }
    if (diagnostic.message.find(kUnknownOutput) != std::string::npos) {
      return;  // it follows from a value that only a run knows
    }
    if (diagnostic.finding == Finding::kNone) {
      diagnostic.finding = Finding::kWrongValue;  // what is visited was well-formed
    }
    // A file that is included twice is checked twice.
    const std::string key =
        fmt::format("{} {} {}", to_string(diagnostic.where), diagnostic.where.end, diagnostic.message);
    if (told_.insert(key).second) {
      found_.push_back(std::move(diagnostic));
    }
  }

  void add(const LaunchError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      add(diagnostic);
    }
  }

  void warn(Finding finding, std::string message, const SourceRange& where, std::string help = {}) {
    add({Severity::kWarning, std::move(message), where, std::move(help), finding});
  }

  void check(const LaunchDescription& description, LaunchContext& context) {
    const ArgumentList list = find_arguments(description, registry_, context.scope());
    std::vector<const LaunchDescription*> all = {&description};
    for (const auto& loaded : list.loaded) {
      all.push_back(loaded.get());
    }
    for (const LaunchDescription* one : all) {
      for (Diagnostic& diagnostic : find_stray_text(one->file)) {
        add(std::move(diagnostic));
      }
      if (options_.strict_ros2) {
        for (Diagnostic& diagnostic : beyond_ros2(one->file, registry_)) {
          add(std::move(diagnostic));
        }
      }
    }
    for (Diagnostic& diagnostic : check_arguments(options_.arguments, description, list, Severity::kWarning)) {
      add(std::move(diagnostic));
    }
    context.scope().forget_left_out_command();
    make_up_arguments(list, context.scope());
    std::vector<Requests> left_out;
    context.exploration().begin(
        {.report = [this](const LaunchError& error, bool is_left_out) { add_of_visit(error, is_left_out); },
         .left_out = [&](Requests requests) { left_out.push_back(std::move(requests)); },
         .strict_ros2 = options_.strict_ros2,
         .finds_leaks = options_.finds_leaks});
    const LaunchPlan plan = plan_launch(context, description);
    context.exploration().tell_postponed();
    if (options_.planned && !lacks_attributes_) {
      options_.planned(plan.processes.size());
    }
    check_unused(description, list, plan);
    const auto report = [this](Diagnostic diagnostic) { add(std::move(diagnostic)); };
    find_faults_of_plan(plan, left_out, report);
    find_remaps_of_unknown_names(plan, options_.recorded_nodes, report);
    find_unknown_parameters(plan, options_.recorded_parameters, report);
  }

  // An argument that has no default and is not given has an unknown value in the visit; what follows from that value is
  // no finding. Where the argument has choices, the first one is visited.
  void make_up_arguments(const ArgumentList& list, Scope& scope) {
    for (const ArgumentInfo& info : list.arguments) {
      const ArgumentDeclaration& argument = *info.declaration;
      if (scope.configurations.contains(argument.name) || info.conditional || argument.default_value ||
          argument.where.file->included_from()) {
        continue;
      }
      warn(Finding::kNotGiven,
           fmt::format("argument '{}' has no default, so what depends on it was not checked", argument.name),
           argument.where, fmt::format("give {}:=VALUE", argument.name));
      scope.configurations.emplace(argument.name,
                                   argument.choices.empty() ? std::string(kUnknownOutput) : argument.choices.front());
    }
  }

  void add_of_visit(const LaunchError& error, bool left_out) {
    for (Diagnostic diagnostic : error.diagnostics()) {
      if (left_out) {
        diagnostic.severity = Severity::kWarning;
        diagnostic.help +=
            fmt::format("{}a condition leaves this out with the arguments given", diagnostic.help.empty() ? "" : "; ");
      }
      add(std::move(diagnostic));
    }
  }

  void check_unused(const LaunchDescription& description, const ArgumentList& list, const LaunchPlan& plan) {
    if (!list.complete || !plan.python_includes.empty()) {
      return;  // it is not known which arguments are read
    }
    std::vector<ArgumentUse> uses;
    const auto add = [&uses](const std::shared_ptr<const SourceFile>& file) {
      if (file != nullptr) {
        uses.emplace_back(file);
      }
    };
    add(description.file);
    for (const auto& loaded : list.loaded) {
      add(loaded->file);
    }
    std::for_each(performed_files_.begin(), performed_files_.end(), add);
    for (const ArgumentInfo& info : list.arguments) {
      const std::string& name = info.declaration->name;
      if (std::none_of(uses.begin(), uses.end(), [&](const ArgumentUse& use) { return use.may_read(name); })) {
        warn(Finding::kUnreadArgument, fmt::format("argument '{}' is never read", name), info.declaration->where);
      }
    }
  }

  const Registry& registry_;
  const Environment& environment_;
  const CheckOptions& options_;
  std::vector<Diagnostic> found_;
  bool lacks_attributes_ = false;                                   // what is visited is not all of the file
  std::vector<std::shared_ptr<const SourceFile>> performed_files_;  // of parameters
  std::set<std::string> told_;
};

}  // namespace

std::vector<Diagnostic> check_launch_file(const std::string& path, const Registry& registry,
                                          const Environment& environment, const CheckOptions& options) {
  return Checker(registry, environment, options).run(path);
}

}  // namespace launch
