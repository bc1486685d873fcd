// SPDX-License-Identifier: Apache-2.0
// The value of an XML attribute with the place of each of its characters.
#pragma once

#include <string_view>

#include "base/diagnostics/source.hpp"

namespace launch {

// `decoded` is the value that tinyxml2 reads at `raw`, with references resolved and line ends as "\n". In the result,
// each literal tab and line end is a space: XML demands it, and tinyxml2 does not do it. A "&#10;" stays a line end.
LocatedText locate_xml_value(const SourceRange& raw, std::string_view decoded);

}  // namespace launch
