// SPDX-License-Identifier: Apache-2.0
// The built-in substitutions: one function and one row of the table at the end for each.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "launcher/substitution/machine_view.hpp"
#include "launcher/substitution/substitution_call.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

std::string truth(bool value) {
  return value ? "true" : "false";
}

std::string var(const SubstitutionCall& call) {
  const std::string name = call.text(0);
  const auto& configurations = call.scope().configurations;
  if (const auto found = configurations.find(name); found != configurations.end()) {
    return found->second;
  }
  if (call.has(1)) {
    return call.text(1);
  }
  std::string help = did_you_mean(name, names_of(configurations));
  if (help.empty()) {
    help = fmt::format("declare it with 'arg', set it with 'let', or give a default: $(var {} DEFAULT)", name);
  }
  call.fail(fmt::format("launch configuration '{}' does not exist", name), std::move(help), Finding::kUndefined);
}

std::string env(const SubstitutionCall& call) {
  const std::string name = call.text(0);
  const Environment& environment = call.scope().environment;
  if (const auto found = environment.find(name); found != environment.end()) {
    return found->second;
  }
  if (const MachineView* const machine = call.scope().machine.get(); machine != nullptr && !machine->is_connected()) {
    return unknown_there(name, *machine);
  }
  if (call.has(1)) {
    return call.text(1);
  }
  std::string help = did_you_mean(name, names_of(environment));
  if (help.empty()) {
    help = fmt::format("give a default, which may be empty: $(env {} '')", name);
  }
  call.fail(fmt::format("environment variable '{}' does not exist", name), std::move(help), Finding::kUndefined);
}

std::string filename(const SubstitutionCall& call) {
  if (call.scope().current_file == nullptr) {
    call.fail("no launch file is being visited here", {});
  }
  return std::filesystem::absolute(call.scope().current_file->path()).lexically_normal().string();
}

std::string dirname(const SubstitutionCall& call) {
  return std::filesystem::path(filename(call)).parent_path().string();
}

std::string find_pkg_prefix(const SubstitutionCall& call) {
  const std::string package = call.text(0);
  return call.look_up_package([&](PackageIndex& index) { return index.prefix(package, call.scope().environment); },
                              package);
}

std::string find_pkg_share(const SubstitutionCall& call) {
  const std::string package = call.text(0);
  std::string path = call.look_up_package(
      [&](PackageIndex& index) { return index.share(package, call.scope().environment); }, package);
  std::error_code ignored;
  if (call.scope().warn && call.scope().machine == nullptr && !std::filesystem::is_directory(path, ignored)) {
    call.scope().warn(call.where(),
                      fmt::format("package '{}' has no share directory: '{}' does not exist", package, path));
  }
  return path;
}

std::string exec_in_pkg(const SubstitutionCall& call) {
  const std::string executable = call.text(0);
  const std::string package = call.text(1);
  const Environment& environment = call.scope().environment;
  // A package that is missing is reported as such, with packages as suggestions.
  call.look_up_package([&](PackageIndex& index) { return index.prefix(package, environment); }, package);
  return call.look_up([&](PackageIndex& index) { return index.executable(executable, package, environment); },
                      executable, [&](PackageIndex& index) { return index.executables(package, environment); },
                      Finding::kMissingProgram);
}

std::string find_exec(const SubstitutionCall& call) {
  const std::string name = call.text(0);
  std::string path;
  try {
    path = call.scope().packages->find_program(name, call.scope().environment);
  } catch (const std::runtime_error& error) {
    call.fail(error.what(), {}, Finding::kMissingProgram);  // of another machine
  }
  if (path.empty()) {
    call.fail(fmt::format("executable '{}' not found on the PATH", name), "install it, or extend the PATH",
              Finding::kMissingProgram);
  }
  return path;
}

std::string log_dir(const SubstitutionCall& call) {
  return call.scope().log_directory;
}

std::string not_(const SubstitutionCall& call) {
  return truth(!call.boolean(0));
}

// `and`, `or`, `all` and `any` perform all their arguments, so that a bad one is found whatever the others are.
std::string all(const SubstitutionCall& call) {
  bool result = true;
  for (std::size_t i = 0; i < call.count(); ++i) {
    result = call.boolean(i) && result;
  }
  return truth(result);
}

std::string any(const SubstitutionCall& call) {
  bool result = false;
  for (std::size_t i = 0; i < call.count(); ++i) {
    result = call.boolean(i) || result;
  }
  return truth(result);
}

std::string equals(const SubstitutionCall& call) {
  return truth(launch_equal(call.text(0), call.text(1)));
}

std::string not_equals(const SubstitutionCall& call) {
  return truth(!launch_equal(call.text(0), call.text(1)));
}

std::string if_(const SubstitutionCall& call) {
  if (call.boolean(0)) {
    return call.text(1);
  }
  return call.has(2) ? call.text(2) : std::string();
}

std::string string_join(const SubstitutionCall& call) {
  const std::string separator = call.text(0);
  std::string result = call.text(1);
  for (std::size_t i = 2; i < call.count(); ++i) {
    result += separator + call.text(i);
  }
  return result;
}

// As os.path.join() of Python: an absolute component forgets what is before it.
std::string path_join(const SubstitutionCall& call) {
  std::string path = call.text(0);
  for (std::size_t i = 1; i < call.count(); ++i) {
    const std::string component = call.text(i);
    if (component.starts_with('/')) {
      path.clear();
    } else if (!path.empty() && !path.ends_with('/')) {
      path += '/';
    }
    path += component;
  }
  return path;
}

// The value of an earlier `set_parameter`. The last one counts, as it does for nodes; parameter files are not searched.
std::string param(const SubstitutionCall& call) {
  const std::string name = call.text(0);
  const std::vector<GlobalParameter>& parameters = call.scope().global_parameters;
  std::vector<std::string> names;
  for (auto parameter = parameters.rbegin(); parameter != parameters.rend(); ++parameter) {
    if (const auto* const named = std::get_if<NamedParameter>(&*parameter)) {
      if (named->name == name) {
        return to_python_text(named->value);
      }
      names.push_back(named->name);
    }
  }
  if (call.has(1)) {
    return call.text(1);
  }
  std::string help = did_you_mean(name, names);
  call.fail(fmt::format("parameter '{}' does not exist", name),
            help.empty()
                ? fmt::format("set it before with 'set_parameter', or give a default: $(param {} DEFAULT)", name)
                : std::move(help),
            Finding::kUndefined);
}

std::string loop_variable(const SubstitutionCall& call, const char* kind, const char* loop) {
  const std::string name = call.text(0);
  const auto& variables = call.scope().loop_variables;
  if (const auto found = variables.find(name); found != variables.end()) {
    return found->second;
  }
  if (call.has(1)) {
    return call.text(1);
  }
  std::string help = did_you_mean(name, names_of(variables));
  call.fail(fmt::format("{} '{}' does not exist here", kind, name),
            help.empty() ? fmt::format("it is set inside a '{}' only", loop) : std::move(help), Finding::kUndefined);
}

std::string for_var(const SubstitutionCall& call) {
  return loop_variable(call, "loop variable", "for_each");
}

std::string index(const SubstitutionCall& call) {
  return loop_variable(call, "loop index", "for");
}

// A substitution that performs one of the functions above.
class Builtin : public Substitution {
 public:
  using Function = std::string (*)(const SubstitutionCall&);

  // In `description`, {0} {1} ... stand for the descriptions of the arguments and {*} for all of them.
  Builtin(Function function, std::string_view description, std::vector<Template> arguments, SourceRange where)
      : Substitution(std::move(where)),
        function_(function),
        description_(description),
        arguments_(std::move(arguments)) {}

  std::string perform(Scope& scope) const override { return function_(SubstitutionCall(arguments_, where(), scope)); }

  std::string describe() const override {
    std::string result;
    for (std::size_t i = 0; i < description_.size(); ++i) {
      if (description_[i] != '{') {
        result += description_[i];
        continue;
      }
      result += placeholder(description_[i + 1]);
      i += 2;
    }
    return result;
  }

 private:
  std::string placeholder(char which) const {
    if (which != '*') {
      const auto index = static_cast<std::size_t>(which - '0');
      return index < arguments_.size() ? arguments_[index].describe() : "''";
    }
    std::string result;
    for (const Template& argument : arguments_) {
      result += (result.empty() ? "" : ", ") + argument.describe();
    }
    return result;
  }

  Function function_;
  std::string_view description_;
  std::vector<Template> arguments_;
};

auto make(Builtin::Function function, std::string_view description) {
  return [=](std::vector<Template> arguments, SourceRange where) -> SubstitutionPtr {
    return std::make_shared<Builtin>(function, description, std::move(arguments), std::move(where));
  };
}

}  // namespace

const std::vector<SubstitutionType>& substitution_types() {
  constexpr int kAny = SubstitutionType::kAnyNumber;
  static const std::vector<SubstitutionType> types = {
      {"var", 1, 2, "$(var NAME [DEFAULT])", "value of a launch configuration", make(var, "LaunchConfig({0})")},
      {"env", 1, 2, "$(env NAME [DEFAULT])", "variable of the launch environment", make(env, "EnvVar({0})")},
      {"dirname", 0, 0, "$(dirname)", "directory of the current launch file", make(dirname, "ThisLaunchFileDir()")},
      {"filename", 0, 0, "$(filename)", "path of the current launch file", make(filename, "ThisLaunchFile()")},
      {"find-pkg-prefix", 1, 1, "$(find-pkg-prefix PKG)", "install prefix of a package",
       make(find_pkg_prefix, "FindPackagePrefix(pkg={0})")},
      {"find-pkg-share", 1, 1, "$(find-pkg-share PKG)", "share directory of a package",
       make(find_pkg_share, "FindPackageShare(pkg={0})")},
      {"exec-in-pkg", 2, 2, "$(exec-in-pkg EXECUTABLE PKG)", "path of a program of a package",
       make(exec_in_pkg, "ExecInPkg(pkg={1}, exec={0})")},
      {"find-exec", 1, 1, "$(find-exec NAME)", "path of a program on the PATH", make(find_exec, "FindExec({0})")},
      {"log_dir", 0, 0, "$(log_dir)", "log directory of this run", make(log_dir, "LaunchLogDir()")},
      {"launch_log_dir", 0, 0, "$(launch_log_dir)", "log directory of this run", make(log_dir, "LaunchLogDir()")},
      {"not", 1, 1, "$(not A)", "true if A is false", make(not_, "NotSubstitution({0})")},
      {"and", 2, 2, "$(and A B)", "true if A and B are true", make(all, "AndSubstitution({*})")},
      {"or", 2, 2, "$(or A B)", "true if A or B is true", make(any, "OrSubstitution({*})")},
      {"all", 0, kAny, "$(all A...)", "true if all are true", make(all, "AllSubstitution({*})")},
      {"any", 0, kAny, "$(any A...)", "true if one of them is true", make(any, "AnySubstitution({*})")},
      {"equals", 2, 2, "$(equals A B)", "true if both are equal as booleans, numbers or text",
       make(equals, "EqualsSubstitution({*})")},
      {"not-equals", 2, 2, "$(not-equals A B)", "true if they are not equal",
       make(not_equals, "NotEqualsSubstitution({*})")},
      {"if", 2, 3, "$(if CONDITION THEN [ELSE])", "THEN or ELSE; only the chosen one is evaluated",
       make(if_, "IfElseSubstitution({0}, {1}, {2})")},
      {"string-join", 2, kAny, "$(string-join SEPARATOR A...)", "the texts with the separator between them",
       make(string_join, "StringJoinSubstitution({*})")},
      {"path-join", 1, kAny, "$(path-join A...)", "the components of a path with slashes between them",
       make(path_join, "PathJoin({*})")},
      {"eval", 1, 2, "$(eval 'EXPRESSION' ['MODULE, ...'])", "value of a Python expression",
       make(eval, "PythonExpr({0})")},
      {"command", 1, 2, "$(command 'COMMAND' [fail|warn|ignore|capture])", "standard output of a command",
       make(command, "Command({0})")},
      {"anon", 1, 1, "$(anon NAME)", "NAME made unique", make(anon, "AnonName({0})")},
      {"param", 1, 2, "$(param NAME [DEFAULT])", "value of an earlier set_parameter", make(param, "Parameter({0})")},
      {"file-content", 1, 1, "$(file-content PATH)", "text of a file", make(file_content, "FileContent({0})")},
      {"for-var", 1, 2, "$(for-var NAME [DEFAULT])", "variable of the enclosing for_each",
       make(for_var, "ForEachVar({0})")},
      {"index", 1, 1, "$(index NAME)", "index of the enclosing for", make(index, "ForLoopIndex({0})")},
  };
  return types;
}

}  // namespace launch
