// SPDX-License-Identifier: Apache-2.0
// Text for XML that is written.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// With entities for the characters that mean something in text and in quoted attributes.
std::string as_xml_text(std::string_view text);

}  // namespace launch
