// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

Json inlay_hints(const Workspace& workspace, const Reading& reading, const Json& range) {
  const std::size_t begin = reading.document.offset(range.at("start"));
  const std::size_t end = reading.document.offset(range.at("end"));
  const std::string& text = reading.document.text();
  Json hints = Json::array();
  for (const OutlineElement& element : reading.outline.elements) {
    for (const OutlineAttribute& attribute : element.attributes) {
      if (!attribute.value || attribute.value->end < begin || attribute.value->begin > end) {
        continue;
      }
      const std::string value = text.substr(attribute.value->begin, attribute.value->end - attribute.value->begin);
      if (value.find("$(") == std::string::npos) {
        continue;
      }
      if (const std::optional<std::string> performed = workspace.performed(reading.path, reading.outline, value)) {
        hints.push_back({{"position", reading.document.position(attribute.value->end)},
                         {"label", "= " + *performed},
                         {"paddingLeft", true}});
      }
    }
  }
  return hints;
}

}  // namespace launch::lsp
