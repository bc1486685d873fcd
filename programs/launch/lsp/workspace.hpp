// SPDX-License-Identifier: Apache-2.0
// What the features of the server look things up in: the documents in the editor, the packages of the environment, and
// other launch files.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "programs/launch/check/recorded_nodes.hpp"
#include "programs/launch/lsp/declared_argument.hpp"
#include "programs/launch/lsp/document.hpp"
#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

class Workspace {
 public:
  // `runs_python`: Python launch files may be run, to learn their arguments and errors.
  explicit Workspace(bool runs_python);

  void open(const std::string& path, std::string text);
  void close(const std::string& path);
  // Null when it is not open.
  Document* find(const std::string& path);
  // The texts that are open, by path.
  std::map<std::string, std::string> texts() const;

  // The open document, or the file. nullopt when there is none.
  std::optional<Document> document(const std::string& path) const;

  const Registry& registry() const { return registry_; }
  const Environment& environment() const { return environment_; }
  bool runs_python() const { return runs_python_; }
  // Whether a Python file that was loaded and did not run may have set configurations, or variables of the environment,
  // that nobody knows of.
  bool has_unknown_settings() const { return *unknown_settings_; }
  void forget_unknown_settings() const { *unknown_settings_ = false; }

  // The nodes of a recorded run, whose names are completed and checked.
  void use_recorded(std::vector<RecordedNode> nodes) { recorded_ = std::move(nodes); }
  const std::vector<RecordedNode>& recorded() const { return recorded_; }

  std::vector<std::string> packages() const;
  std::vector<std::string> executables(const std::string& package) const;
  std::vector<std::string> components() const;  // classes that can be loaded into containers
  // PREFIX/share/PACKAGE and the program; "" when there is none.
  std::string share(const std::string& package) const;
  std::string executable(const std::string& package, const std::string& name) const;

  // The text with its substitutions performed, as far as they are known without a visit: packages, the environment,
  // $(dirname), and arguments with a default. nullopt when something is unknown, or would run code.
  std::optional<std::string> performed(const std::string& path, const Outline& outline, std::string_view text) const;

  // The arguments that a launch file and the files that it includes declare, by their texts. Of a Python file
  // those that it declares itself.
  using Argument = DeclaredArgument;
  std::vector<Argument> arguments_of(const std::string& path) const;

 private:
  void add_arguments_of(const std::string& path, std::set<std::string>& read, std::vector<Argument>& arguments) const;
  Scope scope_in(const std::string& path, const Outline& outline) const;

  bool runs_python_;
  std::shared_ptr<bool> unknown_settings_ = std::make_shared<bool>(false);  // the loader of the registry tells it
  Environment environment_;
  Registry registry_;
  std::shared_ptr<PackageIndex> packages_;
  std::map<std::string, Document> documents_;
  std::vector<RecordedNode> recorded_;
};

}  // namespace launch::lsp
