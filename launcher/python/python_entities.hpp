// SPDX-License-Identifier: Apache-2.0
// Turns what a Python launch file builds into entities, with places in the file.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "launcher/base/source.hpp"
#include "launcher/frontend/entity.hpp"
#include "launcher/language/action.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/substitution/substitution.hpp"

namespace launch {

// A Python launch file and the modules that it takes entities from. Kept by everything that Python may be asked by
// later.
class PythonFile : public std::enable_shared_from_this<PythonFile> {
 public:
  // The registry must outlive everything that is made.
  PythonFile(std::shared_ptr<const SourceFile> file, const Registry& registry)
      : file_(std::move(file)), registry_(registry) {}

  // Checks the entities and makes their actions. Throws LaunchError.
  std::vector<ActionPtr> make_actions(const std::vector<python::Entity>& entities);
  // `fallback` is the place of a text that has none.
  Template make_template(const python::Text& text, const SourceRange& fallback);

  // The place, or the beginning of the launch file when it is unknown.
  SourceRange range(const python::Place& place);

  // Throws what a call of the host threw, or a LaunchError at the place of Python's error.
  [[noreturn]] void fail(const python::Error& error);

 private:
  Entity make_entity(const python::Entity& entity);
  Value make_value(const python::Value& value, const SourceRange& fallback);
  SubstitutionPtr make_part(const python::Part& part, const SourceRange& fallback);

  std::shared_ptr<const SourceFile> file_;
  const Registry& registry_;
  std::map<std::string, std::shared_ptr<const SourceFile>> modules_;
};

}  // namespace launch
