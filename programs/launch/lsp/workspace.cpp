// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/language/launch_description.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "programs/launch/lsp/python_stand_in.hpp"
#include "programs/launch/lsp/python_values.hpp"

namespace launch::lsp {

namespace fs = std::filesystem;

namespace {

// Whether all its substitutions are the launcher's own and run nothing. Others would run Python, or a program, in the
// server.
bool runs_nothing(std::string_view text) {
  for (std::size_t at = text.find("$("); at != std::string_view::npos; at = text.find("$(", at + 2)) {
    const std::size_t begin = at + 2;
    const std::string_view name = text.substr(begin, std::min(text.find_first_of(" )", begin), text.size()) - begin);
    const auto& types = substitution_types();
    if (name == "eval" || name == "command" ||
        std::none_of(types.begin(), types.end(), [&](const SubstitutionType& type) { return type.name == name; })) {
      return false;
    }
  }
  return true;
}

}  // namespace

Workspace::Workspace(bool runs_python)
    : runs_python_(runs_python),
      environment_(own_environment()),
      registry_(builtin_actions()),
      packages_(std::make_shared<PackageIndex>(own_prefix())) {
  if (!runs_python_) {
    // Of Python launch files only what their text tells is known.
    registry_.add_loader(".py",
                         [packages = packages_, environment = environment_, unknown = unknown_settings_](
                             const std::shared_ptr<const SourceFile>& file, const Registry& registry, const Scope&) {
                           PythonStandIn made = python_stand_in(file, registry, [&](const std::string& package) {
                             try {
                               return packages->share(package, environment);
                             } catch (const std::runtime_error&) {
                               return std::string();
                             }
                           });
                           *unknown = *unknown || made.may_set_more;
                           return std::move(made.description);
                         });
  }
}

void Workspace::open(const std::string& path, std::string text) {
  documents_.insert_or_assign(path, Document(std::move(text)));
}

void Workspace::close(const std::string& path) {
  documents_.erase(path);
}

Document* Workspace::find(const std::string& path) {
  const auto found = documents_.find(path);
  return found == documents_.end() ? nullptr : &found->second;
}

std::map<std::string, std::string> Workspace::texts() const {
  std::map<std::string, std::string> all;
  for (const auto& [path, document] : documents_) {
    all.emplace(path, document.text());
  }
  return all;
}

std::optional<Document> Workspace::document(const std::string& path) const {
  const auto found = documents_.find(path);
  if (found != documents_.end()) {
    return found->second;
  }
  std::error_code ignored;
  std::ifstream file(path);
  if (!fs::is_regular_file(path, ignored) || !file) {
    return std::nullopt;
  }
  return Document(std::string(std::istreambuf_iterator<char>(file), {}));
}

std::vector<std::string> Workspace::packages() const {
  return packages_->packages(environment_);
}

std::vector<std::string> Workspace::executables(const std::string& package) const {
  try {
    return packages_->executables(package, environment_);
  } catch (const std::runtime_error&) {
    return {};
  }
}

std::vector<std::string> Workspace::components() const {
  std::set<std::string> classes;
  const auto variable = environment_.find("AMENT_PREFIX_PATH");
  std::istringstream prefixes((variable == environment_.end() ? "" : variable->second + ":") + own_prefix());
  for (std::string prefix; std::getline(prefixes, prefix, ':');) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(prefix + "/share/ament_index/resource_index/rclcpp_components", unreadable)) {
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        classes.insert(line.substr(0, line.find(';')));
      }
    }
  }
  classes.erase("");
  return {classes.begin(), classes.end()};
}

std::string Workspace::share(const std::string& package) const {
  try {
    return packages_->share(package, environment_);
  } catch (const std::runtime_error&) {
    return {};
  }
}

std::string Workspace::executable(const std::string& package, const std::string& name) const {
  try {
    return packages_->executable(name, package, environment_);
  } catch (const std::runtime_error&) {
    return {};
  }
}

Scope Workspace::scope_in(const std::string& path, const Outline& outline) const {
  Scope scope;
  scope.environment = environment_;
  scope.packages = packages_;
  scope.log_directory = LogDirectory::choose(environment_);
  const std::optional<Document> text = document(path);
  scope.current_file = std::make_shared<SourceFile>(path, text ? text->text() : std::string());
  for (const OutlineElement& element : outline.elements) {
    if (!text || (element.tag != "arg" && element.tag != "let")) {
      continue;
    }
    const std::string_view value = value_of(element, element.tag == "arg" ? "default" : "value", text->text());
    const std::string name(value_of(element, "name", text->text()));
    if (name.empty() || element.find(element.tag == "arg" ? "default" : "value") == nullptr || !runs_nothing(value)) {
      continue;
    }
    try {
      scope.configurations.emplace(name, parse_template(LocatedText(std::string(value))).perform(scope));
    } catch (const LaunchError&) {
      // It is not known before a visit.
    }
  }
  return scope;
}

std::optional<std::string> Workspace::performed(const std::string& path, const Outline& outline,
                                                std::string_view text) const {
  if (!runs_nothing(text)) {
    return std::nullopt;
  }
  try {
    Scope scope = scope_in(path, outline);
    return parse_template(LocatedText(std::string(text))).perform(scope);
  } catch (const LaunchError&) {
    return std::nullopt;
  }
}

std::vector<Workspace::Argument> Workspace::arguments_of(const std::string& path) const {
  std::vector<Argument> arguments;
  std::set<std::string> read;
  add_arguments_of(path, read, arguments);
  return arguments;
}

void Workspace::add_arguments_of(const std::string& path, std::set<std::string>& read,
                                 std::vector<Argument>& arguments) const {
  const std::optional<Document> file = read.insert(path).second ? document(path) : std::nullopt;
  if (!file) {
    return;
  }
  if (path.ends_with(".py")) {
    const PythonSource source = python_source_of(file->text());
    const std::vector<Argument> declared =
        python_arguments({[this](const std::string& package) { return share(package); }, path, file->text(), source});
    arguments.insert(arguments.end(), declared.begin(), declared.end());
    return;
  }
  const Outline outline = outline_of(file->text());
  for (std::size_t i = 0; i < outline.elements.size(); ++i) {
    const OutlineElement& element = outline.elements[i];
    const auto value = [&](const char* attribute) { return std::string(value_of(element, attribute, file->text())); };
    if (element.tag == "include") {
      if (const std::optional<std::string> included = performed(path, outline, value("file"))) {
        add_arguments_of((fs::path(path).parent_path() / *included).lexically_normal().string(), read, arguments);
      }
      continue;
    }
    const bool declares = element.tag == "arg" && element.parent >= 0 &&
                          outline.elements[static_cast<std::size_t>(element.parent)].tag != "include";
    if (!declares || value("name").empty()) {
      continue;
    }
    Argument argument = {value("name"),
                         value("description"),
                         element.find("default") == nullptr ? std::nullopt : std::optional(value("default")),
                         {}};
    for (const OutlineElement& choice : outline.elements) {
      if (choice.tag == "choice" && choice.parent == static_cast<int>(i)) {
        argument.choices.emplace_back(value_of(choice, "value", file->text()));
      }
    }
    arguments.push_back(std::move(argument));
  }
}

}  // namespace launch::lsp
