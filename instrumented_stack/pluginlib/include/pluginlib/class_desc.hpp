// SPDX-License-Identifier: Apache-2.0
// What a package tells of one of its plugins.
#pragma once

#include <string>

namespace pluginlib {

struct ClassDesc {
  std::string lookup_name_;            // what loaders ask for: the attribute `name`, else the class
  std::string derived_class_;          // "shapes::Square"
  std::string base_class_;             // "shapes::Shape"
  std::string package_;                // that exports it
  std::string description_;            // for people, without white space around it
  std::string library_name_;           // as the description has it
  std::string resolved_library_path_;  // "UNRESOLVED" until it is loaded
  std::string plugin_manifest_path_;   // of the description
};

}  // namespace pluginlib
