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
#include "base/diagnostics/read_source_file.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "launcher/substitution/unrun_commands.hpp"

namespace launch::lsp {

namespace fs = std::filesystem;

Workspace::Workspace(bool runs_python)
    : runs_python_(runs_python),
      environment_(own_environment()),
      registry_(builtin_actions()),
      packages_(std::make_shared<PackageIndex>(own_prefix())) {
  if (!runs_python_) {
    // Python launch files count as empty: only running them would tell what they do.
    registry_.add_loader(".py", [](std::shared_ptr<const SourceFile> file, const Registry&, const Scope&) {
      auto description = std::make_shared<LaunchDescription>();
      description->file = std::move(file);
      return std::shared_ptr<const LaunchDescription>(std::move(description));
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
  scope.unrun_commands = std::make_shared<UnrunCommands>();
  const std::optional<Document> text = document(path);
  scope.current_file = std::make_shared<SourceFile>(path, text ? text->text() : std::string());
  for (const OutlineElement& element : outline.elements) {
    if (!text || (element.tag != "arg" && element.tag != "let")) {
      continue;
    }
    const std::string_view value = value_of(element, element.tag == "arg" ? "default" : "value", text->text());
    const std::string name(value_of(element, "name", text->text()));
    if (name.empty() || element.find(element.tag == "arg" ? "default" : "value") == nullptr) {
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
  try {
    Scope scope = scope_in(path, outline);
    return parse_template(LocatedText(std::string(text))).perform(scope);
  } catch (const LaunchError&) {
    return std::nullopt;
  }
}

std::vector<Workspace::Argument> Workspace::written_arguments_of(const std::string& path) const {
  std::vector<Argument> arguments;
  const std::optional<Document> file = document(path);
  const Outline outline = file ? outline_of(file->text()) : Outline();
  for (const OutlineElement& element : outline.elements) {
    const bool declares = element.tag == "arg" && element.parent >= 0 &&
                          outline.elements[static_cast<std::size_t>(element.parent)].tag != "include";
    const auto value = [&](const char* attribute) { return std::string(value_of(element, attribute, file->text())); };
    if (declares && !value("name").empty()) {
      arguments.push_back({value("name"),
                           value("description"),
                           element.find("default") == nullptr ? std::nullopt : std::optional(value("default")),
                           {}});
    }
  }
  return arguments;
}

std::vector<Workspace::Argument> Workspace::arguments_of(const std::string& path) const {
  if (path.ends_with(".py") && !runs_python_) {
    return {};
  }
  std::vector<Argument> arguments;
  try {
    set_unsaved_texts(texts());
    Scope scope = scope_in(path, {});
    const auto description = load_launch_description(path, registry_, scope);
    for (const ArgumentInfo& info : find_arguments(*description, registry_, scope).arguments) {
      const ArgumentDeclaration& declaration = *info.declaration;
      arguments.push_back(
          {declaration.name, declaration.description,
           declaration.default_value ? std::optional(declaration.default_value->describe()) : std::nullopt,
           declaration.choices});
    }
  } catch (const LaunchError&) {
    return written_arguments_of(path);  // its own diagnostics tell why
  }
  return arguments;
}

}  // namespace launch::lsp
