#include <fmt/format.h>
#include <tinyxml2.h>

#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/xml_scanner.hpp"

namespace launch {

namespace {

// Builds the entity of `element` and its children; takes their tags from `next` on, which stand in the same order.
Entity build(const tinyxml2::XMLElement& element, std::vector<XmlTag>::iterator& next) {
  XmlTag& tag = *next++;
  Entity entity;
  entity.type_name = element.Name();
  entity.where = tag.where;
  entity.attributes.reserve(tag.attributes.size());
  for (XmlAttribute& attribute : tag.attributes) {
    // Namespace declarations are no attributes to a namespace-aware parser.
    if (attribute.name == "xmlns" || attribute.name.starts_with("xmlns:")) {
      continue;
    }
    Scalar scalar;
    scalar.text = std::move(attribute.value);
    entity.attributes.push_back({std::move(attribute.name),
                                 std::move(attribute.name_where),
                                 {std::move(scalar), std::move(attribute.value_where)}});
  }
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
