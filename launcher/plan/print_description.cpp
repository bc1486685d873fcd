// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <vector>

#include "launcher/frontend/frontend.hpp"
#include "launcher/language/introspection.hpp"
#include "launcher/plan/dry_run.hpp"

namespace launch {

namespace {

std::string as_text(const Value& value) {
  if (const Scalar* const scalar = value.scalar()) {
    return scalar->text.text();
  }
  std::string text;
  for (const Value& item : *value.list()) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", as_text(item));
  }
  return "[" + text + "]";
}

class Printer {
 public:
  explicit Printer(const std::vector<std::shared_ptr<const LaunchDescription>>& loaded) : loaded_(loaded) {}

  void file(const std::shared_ptr<const SourceFile>& source, const std::string& indent) {
    if (source->path().ends_with(".py")) {
      text += indent + "└── (what its Python code makes)\n";
      return;
    }
    children(load_entity_tree(source).children, indent);
  }

  std::string text;

 private:
  void children(const std::vector<Entity>& entities, const std::string& indent) {
    for (const Entity& entity : entities) {
      const bool last = &entity == &entities.back();
      text += fmt::format("{}{} {}", indent, last ? "└──" : "├──", entity.type_name);
      for (const Attribute& attribute : entity.attributes) {
        text += fmt::format(" {}=\"{}\"", attribute.name, as_text(attribute.value));
      }
      text += '\n';
      const std::string below = indent + (last ? "    " : "│   ");
      children(entity.children, below);
      if (entity.type_name == "include") {
        included_at(entity, below);
      }
    }
  }

  void included_at(const Entity& include, const std::string& indent) {
    for (const auto& description : loaded_) {
      if (description->file == nullptr) {
        continue;
      }
      const SourceRange& from = description->file->included_from();
      const Attribute* const path = include.find("file");
      if (path != nullptr && from.file == include.where.file && from.begin >= path->value.where.begin &&
          from.begin < path->value.where.end) {
        text += fmt::format("{}└── {}\n", indent, description->file->path());
        file(description->file, indent + "    ");
        return;
      }
    }
  }

  const std::vector<std::shared_ptr<const LaunchDescription>>& loaded_;
};

}  // namespace

std::string print_description(const LaunchDescription& description, const Registry& registry, const Scope& scope) {
  const ArgumentList list = find_arguments(description, registry, scope);
  Printer printer(list.loaded);
  const auto print = [&](const std::shared_ptr<const SourceFile>& file) {
    printer.text += file->path() + "\n";
    printer.file(file, "");
  };
  if (description.file != nullptr) {
    print(description.file);
  }
  for (const ActionPtr& action : description.actions) {
    if (const auto* const whole = action->introspect().description) {
      print((*whole)->file);
    }
  }
  return printer.text;
}

}  // namespace launch
