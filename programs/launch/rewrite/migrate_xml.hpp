// SPDX-License-Identifier: Apache-2.0
// Launch files of ROS 1, and old names in those of ROS 2, in the words of ROS 2.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace launch {

struct Migrated {
  std::string text;
  std::vector<Diagnostic> left;  // what must be done by hand, at its place in the given file
};

// Throws LaunchError for a file that is not well-formed XML. Comments stay.
Migrated migrate_xml(const std::shared_ptr<const SourceFile>& file);

}  // namespace launch
