// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "launcher/substitution/template_parser.hpp"
#include "programs/launch/lsp/features.hpp"
#include "programs/launch/lsp/language.hpp"

namespace launch::lsp {

namespace {

Json markdown(const Reading& reading, const std::string& text, Span span) {
  return {{"contents", {{"kind", "markdown"}, {"value", text}}},
          {"range", reading.document.range(span.begin, span.end)}};
}

// The "$(…)" of the value that holds the place, without what is around it.
std::optional<Span> substitution_at(const std::string& text, Span value, std::size_t offset) {
  std::vector<std::size_t> begins;
  std::optional<Span> found;
  for (std::size_t i = value.begin; i < value.end; ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text.compare(i, 2, "$(") == 0) {
      begins.push_back(i);
    } else if (text[i] == ')' && !begins.empty()) {
      const Span span = {begins.back(), i + 1};
      begins.pop_back();
      if (span.holds(offset) && (!found || span.begin > found->begin)) {
        found = span;
      }
    }
  }
  return found;
}

const SubstitutionType* find_substitution(const std::string& name) {
  const auto& types = substitution_types();
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.name == name; });
  return found == types.end() ? nullptr : &*found;
}

}  // namespace

Json describe(const Workspace& workspace, const Reading& reading, const Json& position) {
  const std::size_t offset = reading.document.offset(position);
  const std::string& text = reading.document.text();
  for (std::size_t i = reading.outline.elements.size(); i-- > 0;) {
    const OutlineElement& element = reading.outline.elements[i];
    const Declared what = declared(reading.outline, static_cast<int>(i), workspace.registry());
    if (element.tag_span.holds(offset) && !what.help().empty()) {
      return markdown(reading, fmt::format("**{}**: {}", element.tag, what.help()), element.tag_span);
    }
    for (const OutlineAttribute& attribute : element.attributes) {
      if (attribute.name_span.holds(offset)) {
        const std::vector<AttributeSpec> known = what.attributes();
        const AttributeSpec* const spec = find_attribute(known, attribute.name);
        return spec == nullptr
                   ? Json()
                   : markdown(reading,
                              fmt::format("**{}** of {}: {}{}{}{}", spec->name, element.tag, spec->help,
                                          spec->default_value.empty() ? "" : " (default: " + spec->default_value + ")",
                                          spec->required ? " Required." : "",
                                          spec->extension ? " (Not known to ros2 launch.)" : ""),
                              attribute.name_span);
      }
      if (!attribute.value || !attribute.value->holds(offset)) {
        continue;
      }
      const std::optional<Span> span = substitution_at(text, *attribute.value, offset);
      if (!span) {
        return {};
      }
      const std::string call = text.substr(span->begin, span->end - span->begin);
      const SubstitutionType* const type = find_substitution(call.substr(2, call.find_first_of(" )") - 2));
      std::string answer = type == nullptr ? "" : fmt::format("`{}`: {}", type->usage, type->help);
      if (const std::optional<std::string> value = workspace.performed(reading.path, reading.outline, call)) {
        answer += fmt::format("{}gives `{}` here{}", answer.empty() ? "" : "\n\n", *value,
                              call.starts_with("$(var ") ? ", without arguments" : "");
      }
      return answer.empty() ? Json() : markdown(reading, answer, *span);
    }
  }
  return {};
}

}  // namespace launch::lsp
