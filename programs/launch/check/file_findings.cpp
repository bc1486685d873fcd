// SPDX-License-Identifier: Apache-2.0
// What the text of one launch file tells: what `ros2 launch` would not know, and text between elements.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

class Walk {
 public:
  explicit Walk(const Registry& registry) : registry_(registry) {}

  void actions(const std::vector<Entity>& entities) {
    for (const Entity& entity : entities) {
      if (const ActionType* const type = registry_.find(entity.type_name)) {
        action(entity, *type);
      }
    }
  }

  std::vector<Diagnostic> found;

 private:
  void refuse(const std::string& what, const SourceRange& where) {
    found.push_back({Severity::kError, what + " is not known to ros2 launch", where, {}, Finding::kExtension});
  }

  void action(const Entity& entity, const ActionType& type) {
    if (type.extension) {
      refuse(fmt::format("<{}>", entity.type_name), entity.where);
    }
    attributes(entity, type.attributes);
    for (const Entity& child : entity.children) {
      if (const ItemSpec* const item = find(type.items, child.type_name)) {
        this->item(child, *item);
      } else if (type.holds_actions) {
        actions({child});
      }
    }
  }

  void item(const Entity& entity, const ItemSpec& spec) {
    if (spec.extension) {
      refuse(fmt::format("<{}>", entity.type_name), entity.where);
    }
    attributes(entity, spec.attributes);
    for (const Entity& child : entity.children) {
      if (const ItemSpec* const nested = find(spec.items, child.type_name)) {
        item(child, *nested);
      } else if (spec.recursive && child.type_name == spec.tag) {
        item(child, spec);
      }
    }
  }

  void attributes(const Entity& entity, const std::vector<AttributeSpec>& specs) {
    for (const Attribute& attribute : entity.attributes) {
      const auto spec = std::find_if(specs.begin(), specs.end(),
                                     [&](const AttributeSpec& one) { return one.name == attribute.name; });
      if (spec != specs.end() && spec->extension) {
        refuse(fmt::format("attribute '{}' of <{}>", attribute.name, entity.type_name), attribute.name_where);
      }
    }
  }

  static const ItemSpec* find(const std::vector<ItemSpec>& items, const std::string& tag) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const ItemSpec& item) { return item.tag == tag; });
    return found == items.end() ? nullptr : &*found;
  }

  const Registry& registry_;
};

}  // namespace

std::vector<Diagnostic> beyond_ros2(const std::shared_ptr<const SourceFile>& file, const Registry& registry) {
  Walk walk(registry);
  if (file != nullptr && !file->path().ends_with(".py")) {
    walk.actions(load_entity_tree(file).children);
  }
  return std::move(walk.found);
}

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// The end of the markup that begins at `begin` with '<'. Quoted values of attributes may hold '>'.
std::size_t end_of_markup(std::string_view text, std::size_t begin) {
  const auto behind = [&](std::string_view end) {
    const std::size_t found = text.find(end, begin);
    return found == std::string_view::npos ? text.size() : found + end.size();
  };
  if (text.compare(begin, 4, "<!--") == 0) {
    return behind("-->");
  }
  if (text.compare(begin, 2, "<?") == 0) {
    return behind("?>");
  }
  char quote = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (quote != 0) {
      quote = text[i] == quote ? 0 : quote;
    } else if (text[i] == '"' || text[i] == '\'') {
      quote = text[i];
    } else if (text[i] == '>') {
      return i + 1;
    }
  }
  return text.size();
}

// The end of the text, or of the CDATA section, that begins at `begin`.
std::size_t end_of_text(std::string_view text, std::size_t begin) {
  const std::string_view end = text[begin] == '<' ? "]]>" : "<";
  const std::size_t found = text.find(end, begin);
  return found == std::string_view::npos ? text.size() : found + (text[begin] == '<' ? end.size() : 0);
}

}  // namespace

std::vector<Diagnostic> find_stray_text(const std::shared_ptr<const SourceFile>& file) {
  std::vector<Diagnostic> found;
  const std::string_view text = file->text();
  const std::size_t first = text.find_first_not_of(kBlanks, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  // A DOCTYPE holds declarations, with brackets of their own.
  if (first == std::string_view::npos || text[first] != '<' || text.find("<!DOCTYPE") != std::string_view::npos) {
    return found;
  }
  for (std::size_t at = first; at < text.size();) {
    if (text[at] == '<' && text.compare(at, 9, "<![CDATA[") != 0) {
      at = end_of_markup(text, at);
      continue;
    }
    const std::size_t end = end_of_text(text, at);
    const std::size_t begin = text.find_first_not_of(kBlanks, at);
    if (begin < end) {
      const std::size_t line_end = std::min({text.find('\n', begin), text.size(), end});
      const std::size_t last = text.find_last_not_of(kBlanks, line_end - 1);
      found.push_back({Severity::kWarning, "text between elements has no effect",
                       SourceRange{file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(last + 1)},
                       "put it into an attribute or a comment", Finding::kStrayText});
    }
    at = end;
  }
  return found;
}

}  // namespace launch
