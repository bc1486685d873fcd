// SPDX-License-Identifier: Apache-2.0
// Values of launch files as YAML text.
#pragma once

#include <string>
#include <string_view>

#include "launcher/frontend/entity.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// A text that YAML 1.1 reads as this text: with quotes where it would be read as something else.
std::string yaml_string(std::string_view text, bool in_flow);

// A value of XML or YAML. That of XML has no type, so the one of its attribute decides.
std::string yaml_value(const Value& value, AttributeType type, bool in_flow);

}  // namespace launch
