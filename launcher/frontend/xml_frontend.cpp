// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tinyxml2.h>

#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/xml_scanner.hpp"

namespace launch {

namespace {

std::size_t count_children(const tinyxml2::XMLElement& element) {
  std::size_t count = 0;
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    ++count;
  }
  return count;
}

// Builds the entity of `element` and its children; takes their tags from `next` on, which stand in the same order.
Entity build(const tinyxml2::XMLElement& element, std::vector<XmlTag>::iterator& next) {
  XmlTag& tag = *next++;
  Entity entity;
  entity.type_name = std::move(tag.name);
  entity.where = std::move(tag.where);
  entity.attributes = std::move(tag.attributes);
  // Namespace declarations are no attributes to a namespace-aware parser.
  std::erase_if(entity.attributes, [](const Attribute& attribute) {
    return attribute.name == "xmlns" || attribute.name.starts_with("xmlns:");
  });
  entity.children.reserve(count_children(element));
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    entity.children.push_back(build(*child, next));
  }
  return entity;
}

}  // namespace

Entity parse_xml(const std::shared_ptr<const SourceFile>& file) {
  XmlScan scan = scan_xml(file);
  if (!scan.tags.empty() && scan.tags.front().name != "launch") {
    const XmlTag& root = scan.tags.front();
    scan.errors.insert(scan.errors.begin(),
                       {Severity::kError, fmt::format("expected 'launch' as root tag, found '{}'", root.name),
                        root.where, "a launch file is <launch> ... </launch>"});
  }
  if (!scan.errors.empty()) {
    throw LaunchError(std::move(scan.errors));
  }
  tinyxml2::XMLDocument document(/*processEntities=*/false);
  if (document.Parse(scan.markup.data(), scan.markup.size()) != tinyxml2::XML_SUCCESS) {
    throw LaunchError(fmt::format("the XML can't be read: {}", document.ErrorStr()), {file, 0, 0});
  }
  auto next = scan.tags.begin();
  return build(*document.RootElement(), next);
}

}  // namespace launch
