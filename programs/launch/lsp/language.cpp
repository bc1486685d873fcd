// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/language.hpp"

#include <algorithm>

namespace launch::lsp {

namespace {

const ItemSpec* find_item(const std::vector<ItemSpec>& items, std::string_view tag) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const ItemSpec& item) { return item.tag == tag; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

std::vector<AttributeSpec> Declared::attributes() const {
  std::vector<AttributeSpec> all = action != nullptr ? action->attributes
                                   : item != nullptr ? item->attributes
                                                     : std::vector<AttributeSpec>{};
  if (is_root) {
    all.push_back({.name = "version", .help = "the version of the file format, 0.1.0"});
    all.push_back({.name = "deprecated", .help = "a warning for those that launch this file"});
  }
  if (action != nullptr || (item != nullptr && item->has_condition)) {
    for (const char* const condition : {"if", "unless"}) {
      if (find_attribute(all, condition) == nullptr) {
        all.push_back({.name = condition,
                       .type = AttributeType::kBoolean,
                       .help = std::string("visited only ") + condition + " this is true"});
      }
    }
  }
  return all;
}

std::vector<ItemSpec> Declared::items() const {
  if (action != nullptr) {
    return action->items;
  }
  if (item == nullptr) {
    return {};
  }
  std::vector<ItemSpec> all = item->items;
  if (item->recursive) {
    all.push_back(*item);
  }
  return all;
}

bool Declared::holds_actions() const {
  return is_root || (action != nullptr && action->holds_actions);
}

std::string Declared::help() const {
  const std::string text = action != nullptr ? action->help : item != nullptr ? item->help : "";
  const bool extension = action != nullptr ? action->extension : item != nullptr && item->extension;
  return text + (extension ? " (Not known to ros2 launch.)" : "");
}

Declared declared(const Outline& outline, int number, const Registry& registry) {
  if (number < 0) {
    return {.is_root = false};
  }
  const OutlineElement& element = outline.elements[static_cast<std::size_t>(number)];
  if (element.parent < 0) {
    return {.is_root = element.tag == "launch"};
  }
  const Declared around = declared(outline, element.parent, registry);
  const ActionType* const action = around.holds_actions() ? registry.find(element.tag) : nullptr;
  if (action != nullptr) {
    return {.action = action};
  }
  if (around.action != nullptr) {
    return {.item = find_item(around.action->items, element.tag)};
  }
  if (around.item != nullptr) {
    return {.item = around.item->recursive && around.item->tag == element.tag
                        ? around.item
                        : find_item(around.item->items, element.tag)};
  }
  return {};
}

const AttributeSpec* find_attribute(const std::vector<AttributeSpec>& attributes, std::string_view name) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const AttributeSpec& attribute) { return attribute.name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

std::optional<OpenSubstitution> open_substitution(std::string_view text) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text.substr(i).starts_with("$(")) {
      begins.push_back(i + 2);
      ++i;
    } else if (text[i] == ')' && !begins.empty()) {
      begins.pop_back();
    }
  }
  if (begins.empty()) {
    return std::nullopt;
  }
  OpenSubstitution open;
  std::size_t at = begins.back();
  std::size_t end = std::min(text.find(' ', at), text.size());
  open.name = text.substr(at, end - at);
  open.in_name = end == text.size();
  open.begin = at;
  while (end < text.size()) {
    at = end + 1;
    if (at < text.size() && (text[at] == '\'' || text[at] == '"')) {
      const std::size_t close = text.find(text[at], at + 1);
      end = close == std::string_view::npos ? text.size() : std::min(text.find(' ', close), text.size());
      ++at;
    } else {
      end = std::min(text.find(' ', at), text.size());
    }
    std::string_view argument = text.substr(std::min(at, text.size()), end - std::min(at, end));
    if (argument.ends_with('\'') || argument.ends_with('"')) {
      argument.remove_suffix(1);
    }
    open.arguments.emplace_back(argument);
    open.begin = at;
  }
  return open;
}

}  // namespace launch::lsp
