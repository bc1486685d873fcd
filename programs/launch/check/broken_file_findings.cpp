// SPDX-License-Identifier: Apache-2.0
// What is wrong in a file beside its syntax errors, which is names that nobody knows, in the parts that can be read;
// and beside unknown attributes.
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "launcher/frontend/entity.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/language/action_parser.hpp"
#include "programs/launch/check/finders.hpp"
#include "programs/launch/outline/outline.hpp"

namespace launch {

namespace {

using lsp::Outline;
using lsp::OutlineElement;
using lsp::Span;

class BrokenFile {
 public:
  BrokenFile(const std::shared_ptr<const SourceFile>& file, const std::vector<Diagnostic>& syntax_errors)
      : file_(file), outline_(lsp::outline_of(file->text())), syntax_errors_(syntax_errors) {}

  // The actions below the root, without the elements at whose begin something is wrong.
  std::vector<Entity> actions() const {
    std::vector<Entity> found;
    for (std::size_t i = 0; i < outline_.elements.size(); ++i) {
      if (outline_.elements[i].parent >= 0 && outline_.elements[root_of(i)].tag == "launch" &&
          outline_.elements[static_cast<std::size_t>(outline_.elements[i].parent)].parent < 0 && is_whole(i)) {
        found.push_back(entity(i));
      }
    }
    return found;
  }

  bool touches_syntax_error(const SourceRange& where) const {
    const std::uint32_t line = file_->position(where.begin).line;
    return std::any_of(syntax_errors_.begin(), syntax_errors_.end(), [&](const Diagnostic& error) {
      return error.where && file_->position(error.where.begin).line == line;
    });
  }

 private:
  std::size_t root_of(std::size_t number) const {
    while (outline_.elements[number].parent >= 0) {
      number = static_cast<std::size_t>(outline_.elements[number].parent);
    }
    return number;
  }

  SourceRange range(Span span) const {
    return {file_, static_cast<std::uint32_t>(span.begin), static_cast<std::uint32_t>(span.end)};
  }

  bool is_whole(std::size_t number) const {
    const Span head = outline_.elements[number].head;
    const char end = head.end < file_->text().size() ? file_->text()[head.end] : '\0';
    return (outline_.yaml || end == '>' || end == '/') &&
           std::none_of(syntax_errors_.begin(), syntax_errors_.end(), [&](const Diagnostic& error) {
             return error.where && head.begin <= error.where.end && error.where.begin <= head.end;
           });
  }

  Entity entity(std::size_t number) const {
    const OutlineElement& element = outline_.elements[number];
    Entity made;
    made.type_name = element.tag;
    made.where = range(element.tag_span);
    for (const lsp::OutlineAttribute& attribute : element.attributes) {
      const Span span = attribute.value.value_or(attribute.name_span);
      const std::string text = attribute.value ? file_->text().substr(span.begin, span.end - span.begin) : "";
      if (attribute.name.empty() || made.find(attribute.name) != nullptr) {
        continue;
      }
      Scalar scalar{.type = Scalar::Type::kUntyped, .text = LocatedText(text, range(span))};
      made.attributes.push_back({attribute.name, range(attribute.name_span), {std::move(scalar), range(span)}});
    }
    for (std::size_t i = number + 1; i < outline_.elements.size(); ++i) {
      if (outline_.elements[i].parent == static_cast<int>(number) && is_whole(i)) {
        made.children.push_back(entity(i));
      }
    }
    return made;
  }

  const std::shared_ptr<const SourceFile>& file_;
  Outline outline_;
  const std::vector<Diagnostic>& syntax_errors_;
};

// Tags whose attributes change nothing for other actions.
constexpr std::array<std::string_view, 9> kOfProcesses = {
    "node", "executable", "lifecycle_node", "node_container", "composable_node", "param", "remap", "env", "log"};

// Removes the attributes at whose names the errors stand. Returns how many.
std::size_t forget_attributes(std::vector<Entity>& entities, const std::vector<Diagnostic>& errors) {
  std::size_t count = 0;
  for (Entity& entity : entities) {
    if (std::find(kOfProcesses.begin(), kOfProcesses.end(), entity.type_name) != kOfProcesses.end()) {
      count += std::erase_if(entity.attributes, [&](const Attribute& attribute) {
        return std::any_of(errors.begin(), errors.end(), [&](const Diagnostic& error) {
          return error.where && error.where.file->path() == attribute.name_where.file->path() &&
                 error.where.begin == attribute.name_where.begin && error.where.end == attribute.name_where.end;
        });
      });
    }
    count += forget_attributes(entity.children, errors);
  }
  return count;
}

}  // namespace

std::vector<Diagnostic> find_in_broken_file(const std::shared_ptr<const SourceFile>& file, const Registry& registry,
                                            const std::vector<Diagnostic>& syntax_errors) {
  const BrokenFile broken(file, syntax_errors);
  std::vector<Diagnostic> found;
  try {
    ActionParser(registry).parse(broken.actions());
  } catch (const LaunchError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      // Other errors may come from what can't be read.
      if (diagnostic.finding == Finding::kUnknownName && !broken.touches_syntax_error(diagnostic.where)) {
        found.push_back(diagnostic);
      }
    }
  }
  return found;
}

std::shared_ptr<const LaunchDescription> without_unknown_attributes(const std::shared_ptr<const SourceFile>& file,
                                                                    const Registry& registry,
                                                                    const std::vector<Diagnostic>& errors) {
  try {
    Entity root = load_entity_tree(file);
    if (forget_attributes(root.children, errors) != errors.size()) {
      return nullptr;
    }
    auto description = std::make_shared<LaunchDescription>();
    description->actions = ActionParser(registry).parse(std::move(root.children));
    description->file = file;
    return description;
  } catch (const LaunchError&) {
    return nullptr;
  }
}

}  // namespace launch
