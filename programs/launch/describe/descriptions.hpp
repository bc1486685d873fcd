// SPDX-License-Identifier: Apache-2.0
// The launch language, described from the declarations of actions and substitutions.
//
// The schemas are for editors, to complete and check by. They say which elements and attributes there are, which of
// them are required, and what each is for. They can't say what a substitution may give, so the value of an attribute is
// any text.
#pragma once

#include <string>

#include "launcher/language/registry.hpp"

namespace launch {

// Markdown: every action with its attributes and items, every substitution. docs/launch_reference.md holds it.
std::string reference_page(const Registry& registry);

// XML Schema 1.0 of XML launch files.
std::string xml_schema(const Registry& registry);

// JSON Schema, draft 7, of YAML launch files.
std::string json_schema(const Registry& registry);

}  // namespace launch
