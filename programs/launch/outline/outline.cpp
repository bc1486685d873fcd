// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/outline/outline.hpp"

#include <algorithm>

namespace launch::lsp {

const OutlineAttribute* OutlineElement::find(std::string_view name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const OutlineAttribute& attribute) { return attribute.name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

int Outline::element_at(std::size_t offset) const {
  int found = -1;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Span& whole = elements[i].whole;
    if (whole.begin < offset && offset <= whole.end) {
      found = static_cast<int>(i);  // a later one is inside the earlier one
    }
  }
  return found;
}

Outline outline_of(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first == std::string_view::npos || text[first] == '<' ? outline_of_xml(text) : outline_of_yaml(text);
}

std::string_view value_of(const OutlineElement& element, std::string_view attribute, std::string_view text) {
  const OutlineAttribute* const found = element.find(attribute);
  return found == nullptr || !found->value ? std::string_view()
                                           : text.substr(found->value->begin, found->value->end - found->value->begin);
}

}  // namespace launch::lsp
