// SPDX-License-Identifier: Apache-2.0
// Schemas of the launch language, made from the declarations of the actions, for editors to complete and check by.
//
// They say which elements and attributes there are, which of them are required, and what each is for. They can't say
// what a substitution may give, so the value of an attribute is any text.
#pragma once

#include <string>

#include "launcher/language/registry.hpp"

namespace launch {

// XML Schema 1.0 of XML launch files.
std::string xml_schema(const Registry& registry);

// JSON Schema, draft 7, of YAML launch files.
std::string json_schema(const Registry& registry);

}  // namespace launch
