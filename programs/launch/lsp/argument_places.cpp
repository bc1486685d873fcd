// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/argument_places.hpp"

#include <algorithm>

namespace launch::lsp {

namespace {

// The names of the "$(var NAME…)" of a value. A name that is computed is none.
void add_reads(std::string_view text, Span value, std::vector<ArgumentPlace>& places) {
  constexpr std::string_view kVariable = "$(var ";
  for (std::size_t at = text.find(kVariable, value.begin); at < value.end; at = text.find(kVariable, at + 1)) {
    std::size_t begin = at + kVariable.size();
    for (const std::string_view quote : {"'", "\"", "&quot;", "&apos;"}) {
      begin += text.substr(begin).starts_with(quote) ? quote.size() : 0;
    }
    const std::size_t end = std::min(text.find_first_of(")' \"&", begin), value.end);
    if (const std::string_view name = text.substr(begin, end - begin); name.find("$(") == std::string_view::npos) {
      places.push_back({ArgumentPlace::Kind::kRead, std::string(name), {begin, end}});
    }
  }
}

}  // namespace

std::vector<ArgumentPlace> argument_places(const Outline& outline, std::string_view text) {
  std::vector<ArgumentPlace> places;
  for (const OutlineElement& element : outline.elements) {
    const bool names = element.tag == "arg" || element.tag == "let";
    for (const OutlineAttribute& attribute : element.attributes) {
      if (!attribute.value) {
        continue;
      }
      const Span value = *attribute.value;
      if (names && attribute.name == "name") {
        const bool given =
            element.parent >= 0 && outline.elements[static_cast<std::size_t>(element.parent)].tag == "include";
        places.push_back({given ? ArgumentPlace::Kind::kGiven : ArgumentPlace::Kind::kDeclared,
                          std::string(text.substr(value.begin, value.end - value.begin)), value,
                          given ? element.parent : -1});
      } else {
        add_reads(text, value, places);
      }
    }
  }
  return places;
}

}  // namespace launch::lsp
