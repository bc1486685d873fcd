// SPDX-License-Identifier: Apache-2.0
// The value of an XML attribute with the place of each of its characters.
#pragma once

#include <string_view>

#include "launcher/base/source.hpp"

namespace launch {

// `decoded` is what tinyxml2 makes of the value at `raw`: references resolved, line ends as "\n". White space that is
// written as such becomes spaces, as XML demands (and tinyxml2 leaves out); "&#10;" stays a line end.
LocatedText locate_xml_value(const SourceRange& raw, std::string_view decoded);

}  // namespace launch
