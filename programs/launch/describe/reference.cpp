// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "launcher/substitution/template_parser.hpp"
#include "programs/launch/describe/descriptions.hpp"

namespace launch {

namespace {

std::string_view type_text(AttributeType type) {
  switch (type) {
    case AttributeType::kText:
      return "text";
    case AttributeType::kLiteral:
      return "literal";
    case AttributeType::kBoolean:
      return "boolean";
    case AttributeType::kFloat:
      return "float";
    case AttributeType::kInteger:
      return "integer";
    case AttributeType::kCommandLine:
    case AttributeType::kWords:
      return "words";
    case AttributeType::kParameter:
      return "any";
  }
  return "";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    if (character == '|') {
      result += '\\';
    }
    result += character;
  }
  return result;
}

// Marks what `ros2 launch` does not know.
std::string_view mark(bool extension) {
  return extension ? " \\*" : "";
}

std::string attribute_table(const std::vector<AttributeSpec>& attributes) {
  if (attributes.empty()) {
    return "";
  }
  std::string text = "| attribute | type | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const AttributeSpec& attribute : attributes) {
    text +=
        fmt::format("| `{}`{} | {} | {} | {} |\n", attribute.name, mark(attribute.extension), type_text(attribute.type),
                    attribute.required ? "required" : escaped(attribute.default_value), escaped(attribute.help));
  }
  return text + "\n";
}

std::string item_section(const ItemSpec& item, const std::string& kind) {
  return fmt::format("{} `{}`{}: {}{}{}.\n\n", kind, item.tag, mark(item.extension), item.help,
                     item.recursive ? "; may be nested" : "", item.has_condition ? "; takes `if` and `unless`" : "") +
         attribute_table(item.attributes);
}

}  // namespace

std::string reference_page(const Registry& registry) {
  std::string text =
      "# Launch language\n"
      "\n"
      "Made by `launch reference` from the declarations of the actions and substitutions.\n"
      "\n"
      "Every action also takes `if` and `unless`. Types: **text** may hold substitutions, **literal** is text without "
      "them. A **boolean**, **float** or **integer** is a literal, or substitutions that give one. **words** are split "
      "as "
      "a shell does. **any** is a scalar or a list. `ros2 launch` does not know the tags and attributes that are "
      "marked "
      "with \\*: `docs/extensions.md` explains them.\n"
      "\n"
      "## Actions\n"
      "\n";
  for (const auto& [tag, type] : registry.types()) {
    text += fmt::format("### `{}`{}\n\n{}{}\n\n", tag, mark(type.extension), type.help,
                        type.holds_actions ? " Holds actions." : "");
    text += attribute_table(type.attributes);
    for (const ItemSpec& item : type.items) {
      text += item_section(item, "Item");
      for (const ItemSpec& nested : item.items) {
        text += item_section(nested, fmt::format("Item of `{}`,", item.tag));
      }
    }
  }
  text += "## Substitutions\n\n| substitution | gives |\n| --- | --- |\n";
  for (const SubstitutionType& type : substitution_types()) {
    text += fmt::format("| `{}` | {} |\n", escaped(type.usage), escaped(type.help));
  }
  return text;
}

}  // namespace launch
