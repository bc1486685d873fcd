// SPDX-License-Identifier: Apache-2.0
// Writes a text as a YAML scalar.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// Plain if YAML 1.1 reads the plain text as this text, else in single quotes, or in double quotes if it has characters
// that must be escaped. `in_flow`: inside [] or {}, where commas and brackets need quotes.
std::string yaml_text(std::string_view text, bool in_flow);

}  // namespace launch
