// SPDX-License-Identifier: Apache-2.0
// Entities that the DOCTYPE of an XML file declares: <!DOCTYPE launch [<!ENTITY name "text">]>.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace launch {

// The text of each entity, with all references in it resolved, as it counts in the value of an attribute.
using XmlEntities = std::map<std::string, std::string, std::less<>>;

// Left out are entities of other files, those that hold elements, those that hold themselves, and those whose text is
// longer than a launch file needs.
XmlEntities declared_entities(std::string_view doctype);

}  // namespace launch
