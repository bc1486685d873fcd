// The built-in substitutions: one function and one row of the table at the end for each.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

// One use of a substitution while it is performed.
class Call {
 public:
  Call(const std::vector<Template>& arguments, const SourceRange& where, Scope& scope)
      : arguments_(arguments), where_(where), scope_(scope) {}

  std::size_t count() const { return arguments_.size(); }
  bool has(std::size_t index) const { return index < arguments_.size(); }

  // The text of an argument; performed anew by each call.
  std::string text(std::size_t index) const { return arguments_[index].perform(scope_); }

  bool boolean(std::size_t index) const {
    const std::string value = text(index);
    const std::optional<bool> result = yaml_boolean(value);
    if (!result) {
      throw LaunchError(fmt::format("'{}' is not a boolean", value), arguments_[index].where(),
                        "expected true, false, yes, no, on, off, 1 or 0");
    }
    return *result;
  }

  [[noreturn]] void fail(std::string message, std::string help) const {
    throw LaunchError(std::move(message), where_, std::move(help));
  }

  // Runs a look-up of the package index, whose errors have no place, and gives them this one.
  template <typename LookUp, typename Candidates>
  std::string look_up(LookUp find, std::string_view name, Candidates candidates) const {
    try {
      return find(*scope_.packages);
    } catch (const std::runtime_error& error) {
      fail(error.what(), did_you_mean(name, candidates(*scope_.packages)));
    }
  }

  Scope& scope() const { return scope_; }

 private:
  const std::vector<Template>& arguments_;
  const SourceRange& where_;
  Scope& scope_;
};

template <typename Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) {
    names.push_back(name);
  }
  return names;
}

std::string truth(bool value) {
  return value ? "true" : "false";
}

std::string var(const Call& call) {
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
  call.fail(fmt::format("launch configuration '{}' does not exist", name), std::move(help));
}

std::string env(const Call& call) {
  const std::string name = call.text(0);
  const Environment& environment = call.scope().environment;
  if (const auto found = environment.find(name); found != environment.end()) {
    return found->second;
  }
  if (call.has(1)) {
    return call.text(1);
  }
  std::string help = did_you_mean(name, names_of(environment));
  if (help.empty()) {
    help = fmt::format("give a default, which may be empty: $(env {} '')", name);
  }
  call.fail(fmt::format("environment variable '{}' does not exist", name), std::move(help));
}

std::string filename(const Call& call) {
  if (call.scope().current_file == nullptr) {
    call.fail("no launch file is being visited here", {});
  }
  return std::filesystem::absolute(call.scope().current_file->path()).lexically_normal().string();
}

std::string dirname(const Call& call) {
  return std::filesystem::path(filename(call)).parent_path().string();
}

std::string find_pkg_prefix(const Call& call) {
  const std::string package = call.text(0);
  return call.look_up([&](PackageIndex& index) { return index.prefix(package, call.scope().environment); }, package,
                      [&](PackageIndex& index) { return index.packages(call.scope().environment); });
}

std::string find_pkg_share(const Call& call) {
  const std::string package = call.text(0);
  return call.look_up([&](PackageIndex& index) { return index.share(package, call.scope().environment); }, package,
                      [&](PackageIndex& index) { return index.packages(call.scope().environment); });
}

std::string exec_in_pkg(const Call& call) {
  const std::string executable = call.text(0);
  const std::string package = call.text(1);
  const Environment& environment = call.scope().environment;
  // A package that is missing is reported as such, with packages as suggestions.
  call.look_up([&](PackageIndex& index) { return index.prefix(package, environment); }, package,
               [&](PackageIndex& index) { return index.packages(environment); });
  return call.look_up([&](PackageIndex& index) { return index.executable(executable, package, environment); },
                      executable, [&](PackageIndex& index) { return index.executables(package, environment); });
}

std::string find_exec(const Call& call) {
  const std::string name = call.text(0);
  std::string path = PackageIndex::find_on_path(name, call.scope().environment);
  if (path.empty()) {
    call.fail(fmt::format("executable '{}' not found on the PATH", name), {});
  }
  return path;
}

std::string log_dir(const Call& call) {
  return call.scope().log_directory;
}

std::string not_(const Call& call) {
  return truth(!call.boolean(0));
}

// `and`, `or`, `all` and `any` perform all their arguments, so that a bad one is found whatever the others are.
std::string all(const Call& call) {
  bool result = true;
  for (std::size_t i = 0; i < call.count(); ++i) {
    result = call.boolean(i) && result;
  }
  return truth(result);
}

std::string any(const Call& call) {
  bool result = false;
  for (std::size_t i = 0; i < call.count(); ++i) {
    result = call.boolean(i) || result;
  }
  return truth(result);
}

std::string equals(const Call& call) {
  return truth(launch_equal(call.text(0), call.text(1)));
}

std::string not_equals(const Call& call) {
  return truth(!launch_equal(call.text(0), call.text(1)));
}

std::string if_(const Call& call) {
  if (call.boolean(0)) {
    return call.text(1);
  }
  return call.has(2) ? call.text(2) : std::string();
}

std::string string_join(const Call& call) {
  const std::string separator = call.text(0);
  std::string result = call.text(1);
  for (std::size_t i = 2; i < call.count(); ++i) {
    result += separator + call.text(i);
  }
  return result;
}

// A substitution that performs one of the functions above.
class Builtin : public Substitution {
 public:
  using Function = std::string (*)(const Call&);

  // In `description`, {0} {1} ... stand for the descriptions of the arguments and {*} for all of them.
  Builtin(Function function, std::string_view description, std::vector<Template> arguments, SourceRange where)
      : Substitution(std::move(where)),
        function_(function),
        description_(description),
        arguments_(std::move(arguments)) {}

  std::string perform(Scope& scope) const override { return function_(Call(arguments_, where(), scope)); }

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
      {"and", 2, 2, "$(and A B)", "true if both are true", make(all, "AndSubstitution({*})")},
      {"or", 2, 2, "$(or A B)", "true if one of both is true", make(any, "OrSubstitution({*})")},
      {"all", 0, kAny, "$(all A...)", "true if all are true", make(all, "AllSubstitution({*})")},
      {"any", 0, kAny, "$(any A...)", "true if one of them is true", make(any, "AnySubstitution({*})")},
      {"equals", 2, 2, "$(equals A B)", "true if both are equal as booleans, numbers or text",
       make(equals, "EqualsSubstitution({*})")},
      {"not-equals", 2, 2, "$(not-equals A B)", "true if they are not equal",
       make(not_equals, "NotEqualsSubstitution({*})")},
      {"if", 2, 3, "$(if CONDITION THEN [ELSE])", "THEN or ELSE; only the chosen one is performed",
       make(if_, "IfElseSubstitution({0}, {1}, {2})")},
      {"string-join", 2, kAny, "$(string-join SEPARATOR A...)", "the texts with the separator between them",
       make(string_join, "StringJoinSubstitution({*})")},
  };
  return types;
}

}  // namespace launch
