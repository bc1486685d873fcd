// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/check_launch_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <system_error>

#include "launcher/base/own_prefix.hpp"
#include "launcher/base/read_source_file.hpp"
#include "launcher/cli/argument_check.hpp"
#include "launcher/cli/find_launch_file.hpp"
#include "launcher/cli/strict_ros2.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/process/program_search.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

class Checker {
 public:
  Checker(const Registry& registry, const Environment& environment, const CheckOptions& options)
      : registry_(registry), environment_(environment), options_(options) {}

  std::vector<Diagnostic> run(const std::string& path) {
    try {
      LaunchContext context(registry_, environment_, own_prefix(), [](auto, auto, auto) {});
      context.scope().warn = [this](const SourceRange& where, const std::string& text) {
        warn(Finding::kRemark, text, where);
      };
      for (const auto& [name, value] : options_.arguments) {
        context.scope().configurations.insert_or_assign(name, value);
      }
      check(*load_launch_files({path}, registry_, context.scope()), context);
    } catch (const LaunchError& error) {
      add(error);
      check_what_does_not_load(path);
    }
    return std::move(found_);
  }

 private:
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

  void add(Diagnostic diagnostic) {
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
    if (options_.strict_ros2) {
      std::vector<const LaunchDescription*> all = {&description};
      for (const auto& loaded : list.loaded) {
        all.push_back(loaded.get());
      }
      for (const LaunchDescription* one : all) {
        for (Diagnostic& diagnostic : beyond_ros2(one->file, registry_)) {
          add(std::move(diagnostic));
        }
      }
    }
    for (Diagnostic& diagnostic : check_arguments(options_.arguments, description, list, Severity::kWarning)) {
      add(std::move(diagnostic));
    }
    if (!all_given(list)) {
      return;
    }
    context.explore([this](const LaunchError& error, bool left_out) { add_of_visit(error, left_out); });
    const LaunchPlan plan = plan_launch(context, description);
    check_unused(description, list, plan);
    check_nodes(plan);
    check_processes(plan);
  }

  void check_processes(const LaunchPlan& plan) {
    for (const ProcessSpec& spec : plan.processes) {
      check_program(spec);
      check_parameter_files(spec);
      check_remaps(spec);
    }
    for (const PlannedHandler& planned : plan.handlers) {
      check_processes(planned.plan);
    }
  }

  // A launch file can't be visited when nobody gives an argument that it needs.
  bool all_given(const ArgumentList& list) {
    bool all = true;
    for (const ArgumentInfo& info : list.arguments) {
      const ArgumentDeclaration& argument = *info.declaration;
      const bool given = std::any_of(options_.arguments.begin(), options_.arguments.end(),
                                     [&](const auto& pair) { return pair.first == argument.name; });
      if (!given && !info.conditional && !argument.default_value && !argument.where.file->included_from()) {
        warn(Finding::kNotGiven,
             fmt::format("argument '{}' has no default, so nothing that is visited was checked", argument.name),
             argument.where, fmt::format("give {}:=VALUE", argument.name));
        all = false;
      }
    }
    return all;
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
    const auto any_reads = [&](const std::function<bool(const LaunchDescription&)>& reads) {
      return reads(description) ||
             std::any_of(list.loaded.begin(), list.loaded.end(), [&](const auto& loaded) { return reads(*loaded); });
    };
    // It can't be known which argument a computed name reads, nor which arguments Python code reads.
    const bool computed = any_reads([](const LaunchDescription& file) {
      return file.file != nullptr && (file.file->text().find("$(var $(") != std::string::npos ||
                                      file.file->text().find("$(var '$(") != std::string::npos);
    });
    if (computed) {
      return;
    }
    for (const ArgumentInfo& info : list.arguments) {
      const std::string& name = info.declaration->name;
      if (!any_reads([&](const LaunchDescription& file) { return is_read_in(file, name); })) {
        warn(Finding::kUnreadArgument, fmt::format("argument '{}' is never read", name), info.declaration->where);
      }
    }
  }

  void check_nodes(const LaunchPlan& plan) {
    std::map<std::string, SourceRange> seen;
    for (const NodeDescription& node : plan.nodes) {
      if (!node.name) {
        continue;
      }
      const std::string space = node.name_space.value_or("/");
      const std::string full = (space.empty() || space.front() != '/' ? "/" : "") + space +
                               (space.empty() || space.back() == '/' ? "" : "/") + *node.name;
      const SourceRange& origin = plan.processes[node.process].origin;
      const auto [first, is_new] = seen.emplace(full, origin);
      if (!is_new) {
        warn(Finding::kSameNode, fmt::format("another node is named '{}'", full), origin,
             "the first is at " + to_string(first->second));
      }
    }
  }

  void check_program(const ProcessSpec& spec) {
    if (spec.shell) {
      return;
    }
    try {
      fs::path program = find_program(spec);
      if (program.is_relative() && !spec.working_directory.empty()) {
        program = spec.working_directory / program;
      }
      if (::access(program.c_str(), X_OK) != 0) {
        throw std::system_error(errno, std::generic_category());
      }
    } catch (const std::system_error& error) {
      add({Severity::kError,
           fmt::format("program '{}' can't be run: {}", spec.argv.front(), error.code().message()),
           spec.origin,
           {},
           Finding::kMissingProgram});
    }
  }

  void check_parameter_files(const ProcessSpec& spec) {
    for (std::size_t i = 1; i < spec.argv.size(); ++i) {
      const bool generated = std::any_of(spec.files.begin(), spec.files.end(),
                                         [&](const GeneratedFile& file) { return file.argument == i; });
      if (spec.argv[i - 1] != "--params-file" || generated) {
        continue;
      }
      fs::path path = spec.argv[i];
      if (path.is_relative() && !spec.working_directory.empty()) {
        path = spec.working_directory / path;
      }
      std::error_code ignored;
      if (!fs::is_regular_file(path, ignored)) {
        add({Severity::kError,
             fmt::format("parameter file '{}' does not exist", spec.argv[i]),
             spec.origin,
             {},
             Finding::kMissingParameterFile});
      }
    }
  }

  // `-r [node:]from:=to`
  void check_remaps(const ProcessSpec& spec) {
    std::string node;
    for (std::size_t i = 1; i < spec.argv.size(); ++i) {
      if (spec.argv[i - 1] == "-r" && spec.argv[i].rfind("__node:=", 0) == 0) {
        node = spec.argv[i].substr(8);
      }
    }
    for (std::size_t i = 1; i < spec.argv.size(); ++i) {
      const std::size_t separator = spec.argv[i].find(":=");
      if (spec.argv[i - 1] != "-r" || separator == std::string::npos) {
        continue;
      }
      std::string from = spec.argv[i].substr(0, separator);
      if (const std::size_t colon = from.find(':'); colon != std::string::npos) {
        if (!node.empty() && from.substr(0, colon) != node) {
          warn(Finding::kUselessRemap,
               fmt::format("remap '{}' matches nothing: this node is named '{}'", spec.argv[i], node), spec.origin);
        }
        from.erase(0, colon + 1);
      }
      if (from == spec.argv[i].substr(separator + 2)) {
        warn(Finding::kUselessRemap, fmt::format("remap '{}' changes nothing", spec.argv[i]), spec.origin);
      }
    }
  }

  const Registry& registry_;
  const Environment& environment_;
  const CheckOptions& options_;
  std::vector<Diagnostic> found_;
  std::set<std::string> told_;
};

}  // namespace

std::vector<Diagnostic> check_launch_file(const std::string& path, const Registry& registry,
                                          const Environment& environment, const CheckOptions& options) {
  return Checker(registry, environment, options).run(path);
}

}  // namespace launch
