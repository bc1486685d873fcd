// SPDX-License-Identifier: Apache-2.0
// A launch file in the form in which the documentation writes launch files. What it means stays the same.
#pragma once

#include <memory>
#include <string>

#include "base/diagnostics/source.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// Lines are broken before they are longer than this, where that is possible.
inline constexpr std::size_t kFormattedColumns = 120;

// XML or YAML, by the content. Throws LaunchError for a file with syntax errors, and for a form that is not known how
// to write anew. Comments stay, and so do blank lines, one of several. The text has line ends of the file's first kind.
std::string formatted(const std::shared_ptr<const SourceFile>& file, const Registry& registry);

std::string formatted_xml(std::string_view text,
                          const Registry& registry);                        // the text of a file that parse_xml() takes
std::string formatted_yaml(const std::shared_ptr<const SourceFile>& file);  // a file that parse_yaml() takes

}  // namespace launch
