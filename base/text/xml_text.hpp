// SPDX-License-Identifier: Apache-2.0
// Writes text for XML.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// The text with entities for the characters that mean something in XML text and in quoted attributes.
std::string as_xml_text(std::string_view text);

}  // namespace launch
