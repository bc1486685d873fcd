// SPDX-License-Identifier: Apache-2.0
// A Python launch file. The objects that it builds become actions; while it runs, its calls act on the launch.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/frontend/entity.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/substitution/substitution.hpp"

namespace launch {

// Turns the file names and lines of Python's objects and errors into places in the kept source text: those of one
// launch file and of the modules that it takes objects from.
class PythonPlaces {
 public:
  explicit PythonPlaces(std::shared_ptr<const SourceFile> file) : file_(std::move(file)) {}

  // Of the launch file.
  const std::string& path() const { return file_->path(); }

  // The place, or the beginning of the launch file when it is unknown.
  SourceRange range(const python::Place& place);

  // Throws the exception of a call of the host, or a LaunchError at the place of Python's error.
  [[noreturn]] void fail(const python::Error& error);

 private:
  std::shared_ptr<const SourceFile> file_;
  std::map<std::string, std::shared_ptr<const SourceFile>> modules_;
};

class LaunchContext;

// Makes actions and templates of the entities that Python gives. Everything that asks Python later keeps the file
// alive.
class PythonFile : public std::enable_shared_from_this<PythonFile> {
 public:
  // The registry must outlive everything that is made.
  PythonFile(std::shared_ptr<const SourceFile> file, const Registry& registry)
      : places_(std::move(file)), registry_(registry) {}

  // Checks the entities and makes their actions. Throws LaunchError.
  std::vector<ActionPtr> make_actions(const std::vector<python::Entity>& entities);
  // `fallback` is the place of a text that has none.
  Template make_template(const python::Text& text, const SourceRange& fallback);

  PythonPlaces& places() { return places_; }

  // Keeps an element or a substitution of an XML or YAML file. Python names it by the number that is returned.
  std::size_t keep(Entity entity);
  std::size_t keep(SubstitutionPtr substitution);

 private:
  Entity make_entity(const python::Entity& entity);
  Value make_value(const python::Value& value, const SourceRange& fallback);
  SubstitutionPtr make_part(const python::Part& part, const SourceRange& fallback);

  PythonPlaces places_;
  const Registry& registry_;
  std::vector<Entity> elements_;
  std::vector<SubstitutionPtr> substitutions_;
};

// The launch, for Python while it runs.
class PythonHost : public python::Host {
 public:
  // For loading a file or performing a substitution. Calls that need a visit throw.
  // Throws LaunchError when the guest that runs Python was ended by this file before.
  PythonHost(PythonFile& file, Scope& scope);
  PythonHost(PythonFile& file, LaunchContext& context);

  Variables& configurations() override { return scope_.configurations; }
  Variables& environment() override { return scope_.environment.own(); }
  std::string log_directory() override { return scope_.log_directory; }
  std::string perform(const python::Text& text) override;
  std::string perform(const python::Text& text, Variables& configurations) override;
  void message(const std::string& level, const std::string& logger, const std::string& text) override;
  void push(bool environment) override;
  void pop(bool environment) override;
  void visit(const std::vector<python::Entity>& entities) override;
  void run_coroutine(python::ObjectPtr object) override;

 private:
  LaunchContext& context();

  PythonFile& file_;
  Scope& scope_;
  GuestCall call_;
  LaunchContext* context_ = nullptr;
};

}  // namespace launch
