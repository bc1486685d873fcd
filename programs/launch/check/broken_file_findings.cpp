// SPDX-License-Identifier: Apache-2.0
// What is wrong in a file beside its syntax errors: names that nobody knows, in the parts that can be read.
#include <algorithm>
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

}  // namespace launch
